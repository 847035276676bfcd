"""Car axis: two point masses on an axle of fixed length, on springs over a bumpy road (test set for IVP solvers).

The road line from the left to the right contact point has the length of the axle and rotates about the left contact
point. The left mass slides on the normal of this line.
"""

from __future__ import annotations

from acausal import Model, Scalar, asin, chain, connect, fixed, output, sin, time
from components import Body, FixedTranslation, Prismatic, Revolute, Spring, World
from components.rotational import Position

MASS = 10 * 1e-2**2 / 2  # K = M eps^2 / 2


class CarAxis(Model):
    """Masses K at both ends of a massless axle of 1 m; the right contact point has the height 0.1 sin(10 t)."""

    stop_time = 3.0
    world = World(g=1)
    turn = Revolute(use_axis_flange=True)
    drive = Position()
    road = FixedTranslation(r=(1, 0, 0))
    normal = Prismatic(n=(0, 1, 0), s=fixed(0.5), v=fixed(0))
    left, right = Body(m=MASS), Body(m=MASS)
    hinge = Revolute(phi=fixed(0), w=fixed(-1))
    axle = FixedTranslation(r=(1, 0, 0))
    left_spring, right_spring = Spring(c=1, s_unstretched=0.5), Spring(c=1, s_unstretched=0.5)
    xl: Scalar = output("horizontal position of the left mass, in the world", unit="m")
    yl: Scalar = output("vertical position of the left mass, in the world", unit="m")
    xr: Scalar = output("horizontal position of the right mass, in the world", unit="m")
    yr: Scalar = output("vertical position of the right mass, in the world", unit="m")

    def connections(self):
        yield connect(self.drive.flange, self.turn.axis)
        yield chain(self.world, self.turn, self.normal, self.hinge, self.axle, self.right)
        yield connect(self.normal.frame_b, self.left.frame_a)
        yield chain(self.turn, self.road, self.right_spring, self.right.frame_a)
        yield chain(self.world, self.left_spring, self.left.frame_a)

    def equations(self):
        yield self.drive.phi_ref == asin(0.1 * sin(10 * time))
        yield self.xl == self.left.r_0[0]
        yield self.yl == self.left.r_0[1]
        yield self.xr == self.right.r_0[0]
        yield self.yr == self.right.r_0[1]


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(CarAxis(), stop_time=CarAxis.stop_time).plot("xl", "yl", "xr", "yr", path="car-axis.png")
