"""SphericalSpherical: a rod with a ball joint at each end."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Expr, Scalar, as_expr, der, dot, geometry, outer, parameter, structural, variable
from components.frame import TwoFrames
from components.orientation import resolve1, resolve2
from components.world import World


class SphericalSpherical(TwoFrames):
    """Rod with a ball joint at each end, which keeps the distance of frame_a and frame_b; its mass, if any, is in the middle.

    Notes
    -----
    |r_b - r_a| = rod_length; with compute_rod_length=True, what it is at the start, for which one more position is given. The
    point mass m divides the part of its force across the rod between the ends; the part along the rod acts at frame_b, beside
    f_rod.
    """

    compute_rod_length: bool = structural(
        "whether the length is the distance at the start", default=False, choices=(True, False)
    )
    rod_length: Scalar = parameter(
        "distance of the origins of frame_a and frame_b",
        unit="m",
        default=lambda self: 1.0 if self.compute_rod_length else 0.0,  # 0 is refused: it is to be given
        positive=True,
        doc="A guess with compute_rod_length=True.",
    )
    m: Scalar = parameter("mass, in the middle of the rod", unit="kg", default=0, minimum=0)
    f_rod: Scalar = variable("force along the rod on frame_a, positive towards frame_b", unit="N")
    length: Scalar = variable("length of the rod", unit="m", start=rod_length)
    length_start: Any = variable(
        "its state with compute_rod_length=True",
        unit="m",
        shape=lambda self: (1,) if self.compute_rod_length else (0,),
        start=rod_length,
    )
    world: World = outer(World)

    def declared_derivatives(self):
        if self.compute_rod_length:
            yield self.length, as_expr(0.0)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        r, length = b.r_0 - a.r_0, self.length if self.compute_rod_length else self.rod_length
        e = r / length
        force = self.m * ((resolve1(a.R, a.a) + resolve1(b.R, b.a)) / 2 - self.world.acceleration(self._middle()))
        along = dot(force, e) * e
        yield self.length == (self.length_start[0] if self.compute_rod_length else self.rod_length)
        yield der(self.length_start) == np.zeros(len(self.length_start))
        yield dot(r, r) == length**2
        yield a.f == resolve2(a.R, (force - along) / 2 + e * self.f_rod)
        yield b.f == resolve2(b.R, (force + along) / 2 - e * self.f_rod)
        yield a.t == (0, 0, 0)
        yield b.t == (0, 0, 0)

    def stored_energy(self):
        """Kinetic and potential energy of the mass."""
        v = self._velocity()
        return self.m * (dot(v, v) / 2 + self.world.gravity_potential(self._middle()))

    def supplied_power(self):
        """Power of gravity without a potential."""
        return self.world.power(self.m, self._middle(), self._velocity())

    def shapes(self):
        """The rod."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0)

    def _middle(self) -> Expr:
        return (self.frame_a.r_0 + self.frame_b.r_0) / 2

    def _velocity(self) -> Expr:
        a, b = self.frame_a, self.frame_b
        return (resolve1(a.R, a.v) + resolve1(b.R, b.v)) / 2
