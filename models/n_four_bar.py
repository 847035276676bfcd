"""N four-bars side by side, all parallelograms, which pass through their flat singular configuration."""

from __future__ import annotations

from acausal import Model, Scalar, chain, fixed, output, parts, structural
from components import BodyRod, Fixed, Revolute, World


class NFourBar(Model):
    """N + 1 uprights and N couplers, uniform rods of 1 m and 1 kg; the upper ends start at 1 m/s along x."""

    stop_time = 10.0
    N: int = structural("number of four-bars", default=2, minimum=1)
    world = World(g=9.81)
    b0_x: Scalar = output("horizontal position of the upper end of the first upright, in the world", unit="m")
    b0_y: Scalar = output("vertical position of the upper end of the first upright, in the world", unit="m")

    @parts
    def ground(self):
        """Ground points."""
        return [Fixed(r=(i, 0, 0)) for i in range(self.N + 1)]

    @parts
    def foot(self):
        """Joints between ground and uprights; the first one fixes the initial state."""
        return [Revolute(phi=fixed(0), w=fixed(-1)), *(Revolute() for _ in range(self.N))]

    @parts
    def upright(self):
        """Uprights."""
        return [BodyRod(r=(0, 1, 0), m=1) for _ in range(self.N + 1)]

    @parts
    def coupler(self):
        """Couplers."""
        return [BodyRod(r=(1, 0, 0), m=1) for _ in range(self.N)]

    @parts
    def pin(self):
        """Joints at the ends of the couplers, two for each."""
        return [Revolute() for _ in range(2 * self.N)]

    def connections(self):
        for i in range(self.N + 1):
            yield chain(self.ground[i], self.foot[i], self.upright[i])
        for i in range(self.N):
            left, right = self.pin[2 * i : 2 * i + 2]
            yield chain(self.upright[i], left, self.coupler[i], right, self.upright[i + 1].frame_b)

    def equations(self):
        yield self.b0_x == self.upright[0].frame_b.r_0[0]
        yield self.b0_y == self.upright[0].frame_b.r_0[1]


if __name__ == "__main__":
    import acausal as ac

    ac.simulate(NFourBar(), stop_time=NFourBar.stop_time).plot("b0_x", "b0_y", path="n-four-bar.png")
