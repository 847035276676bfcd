"""SphericalSpherical: rod with a ball joint at each end."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Expr, Scalar, as_expr, der, dot, geometry, outer, parameter, structural, variable
from components.frame import TwoFrames, pose
from components.orientation import resolve1, resolve2
from components.world import World


class SphericalSpherical(TwoFrames):
    """Rod with a ball joint at each end: constant distance of frame_a and frame_b, optional point mass at the midpoint.

    Notes
    -----
    |r_b - r_a| = rod_length; with compute_rod_length=True the initial distance, which requires one more fixed position. The
    transverse component of the inertia load of m is divided equally between the ends; its axial component acts at frame_b,
    in addition to f_rod.
    """

    compute_rod_length: bool = structural(
        "whether the length is the initial distance", default=False, choices=(True, False)
    )
    rod_length: Scalar = parameter(
        "distance between the origins of frame_a and frame_b",
        unit="m",
        default=lambda self: 1.0 if self.compute_rod_length else 0.0,  # 0 is invalid: a mandatory parameter
        positive=True,
        doc="A guess with compute_rod_length=True.",
    )
    m: Scalar = parameter("mass at the midpoint of the rod", unit="kg", default=0, minimum=0)
    f_rod: Scalar = variable("force along the rod on frame_a, positive towards frame_b", unit="N")
    length: Scalar = variable("length of the rod", unit="m", start=rod_length)
    length_start: Any = variable(
        "length as a state, with compute_rod_length=True",
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
        """The rod between two balls."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0)
        for frame in (self.frame_a, self.frame_b):
            yield geometry.Axle(pose(frame), (0, 0, 1), style="ball")

    def _middle(self) -> Expr:
        return (self.frame_a.r_0 + self.frame_b.r_0) / 2

    def _velocity(self) -> Expr:
        a, b = self.frame_a, self.frame_b
        return (resolve1(a.R, a.v) + resolve1(b.R, b.v)) / 2
