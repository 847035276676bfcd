"""Spatial four-bar: crank, coupler and slider with revolute joints (Modelica's Loops.Fourbar1)."""

from __future__ import annotations

from acausal import Model, Scalar, chain, fixed, guess, output
from components import BodyCylinder, FixedTranslation, Prismatic, Revolute, World

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


class FourBarSpatial(Model):
    """Crank b1 about x, slider b2 along x and coupler b3 between them, with an initial angular velocity."""

    stop_time = 5.0
    world = World(g=9.80665)
    j1 = Revolute(n=X, phi=fixed(0), w=fixed(5.235987756))
    b1 = BodyCylinder(r=(0, 0.5, 0.1), diameter=0.05)
    j3 = Revolute(n=X)
    j4 = Revolute(n=Y)
    j5 = Revolute(n=Z)
    b0 = FixedTranslation(r=(1.2, 0, 0))
    j2 = Prismatic(n=X, s=guess(-0.2))
    b2 = BodyCylinder(r=(0, 0.2, 0), diameter=0.05)
    rev = Revolute(n=Y)
    rev1 = Revolute(n=Z)
    b3 = BodyCylinder(r=(-1, 0.3, 0.1), diameter=0.05)
    j1_phi: Scalar = output("angle of the crank", unit="rad")
    j1_w: Scalar = output("angular velocity of the crank", unit="rad/s")

    def connections(self):
        yield chain(self.world, self.j1, self.b1, self.j3, self.j4, self.j5, self.b3.frame_b)
        yield chain(self.world, self.b0, self.j2, self.b2, self.rev, self.rev1, self.b3)

    def equations(self):
        yield self.j1_phi == self.j1.phi
        yield self.j1_w == self.j1.w


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(FourBarSpatial(), stop_time=FourBarSpatial.stop_time).plot("j1_phi", "j1_w", path="spatial.png")
