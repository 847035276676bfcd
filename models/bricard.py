"""Bricard's mechanism: six revolute joints, no adjacent ones parallel, five moving rods, one degree of freedom."""

from __future__ import annotations

from acausal import Model, Scalar, chain, fixed, output, parts
from components import BodyBox, Fixed, Revolute, World

AXES = ((0, 1, 0), (0, 0, 1), (1, 0, 0)) * 2
RODS = ((1, 0, 0), (0, -1, 0), (0, 0, 1), (-1, 0, 0), (0, 1, 0))


class Bricard(Model):
    """Rods of 1 m and 1 kg along edges of a cube, released at rest."""

    stop_time = 10.0
    world = World(g=9.81)
    end = Fixed(r=(0, 0, 1))
    x: Scalar = output("position of the point that starts at (1, -1, 0), in the world", unit="m")
    y: Scalar = output("position of the point that starts at (1, -1, 0), in the world", unit="m")
    z: Scalar = output("position of the point that starts at (1, -1, 0), in the world", unit="m")

    @parts
    def joint(self):
        """The six revolute joints; the first one fixes the initial state."""
        return [Revolute(n=AXES[0], phi=fixed(0), w=fixed(0)), *(Revolute(n=n) for n in AXES[1:])]

    @parts
    def rod(self):
        """The five moving rods."""
        return [BodyBox(r=r, width=0.1, m=1) for r in RODS]

    def connections(self):
        links = [part for pair in zip(self.joint, self.rod, strict=False) for part in pair]
        yield chain(self.world, *links, self.joint[5], self.end.frame_b)

    def equations(self):
        point = self.rod[1].frame_b.r_0
        yield self.x == point[0]
        yield self.y == point[1]
        yield self.z == point[2]


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(Bricard(), stop_time=Bricard.stop_time).plot("x", "y", "z", path="bricard.png")
