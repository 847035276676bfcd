"""SphericalSpherical: a rod with a ball joint at each end."""

from __future__ import annotations

from acausal import Expr, Scalar, dot, geometry, outer, parameter, variable
from components.frame import TwoFrames
from components.orientation import resolve1, resolve2
from components.world import World


class SphericalSpherical(TwoFrames):
    """Rod with a ball joint at each end, which keeps the distance of frame_a and frame_b; its mass, if any, is in the middle.

    Notes
    -----
    |r_b - r_a| = rod_length. The point mass m divides the part of its force across the rod between the ends; the part along
    the rod acts at frame_b, beside f_rod.
    """

    rod_length: Scalar = parameter("distance of the origins of frame_a and frame_b", unit="m", positive=True)
    m: Scalar = parameter("mass, in the middle of the rod", unit="kg", default=0, minimum=0)
    f_rod: Scalar = variable("force along the rod on frame_a, positive towards frame_b", unit="N")
    world: World = outer(World)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        r = b.r_0 - a.r_0
        e = r / self.rod_length
        force = self.m * ((resolve1(a.R, a.a) + resolve1(b.R, b.a)) / 2 - self.world.acceleration(self._middle()))
        along = dot(force, e) * e
        yield dot(r, r) == self.rod_length**2
        yield a.f == resolve2(a.R, (force - along) / 2 + e * self.f_rod)
        yield b.f == resolve2(b.R, (force + along) / 2 - e * self.f_rod)
        yield a.t == (0, 0, 0)
        yield b.t == (0, 0, 0)

    def stored_energy(self):
        """Kinetic and potential energy of the mass."""
        v = self._velocity()
        return self.m * (dot(v, v) / 2 + self.world.gravity_potential(self._middle()))

    def supplied_power(self):
        """Power of gravity that has no potential."""
        return self.world.power(self.m, self._middle(), self._velocity())

    def shapes(self):
        """The rod."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0)

    def _middle(self) -> Expr:
        return (self.frame_a.r_0 + self.frame_b.r_0) / 2

    def _velocity(self) -> Expr:
        a, b = self.frame_a, self.frame_b
        return (resolve1(a.R, a.v) + resolve1(b.R, b.v)) / 2
