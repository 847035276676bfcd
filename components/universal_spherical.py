"""UniversalSpherical: rod with a universal joint and a ball joint at its ends."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import (
    DeclarationError,
    Expr,
    Scalar,
    Vector3,
    as_expr,
    branch,
    cross,
    der,
    dot,
    geometry,
    port,
    require,
    structural,
    variable,
)
from components.frame import Frame, TwoFrames, move, pose
from components.orientation import (
    RelativeOrientation,
    norm,
    outer_product,
    parallel,
    resolve1,
    resolve2,
    unit_vector,
)
from components.world import require_direction

# Sine of the angle between the rod and n1_a that counts as 0, as in parallel().
ALONG = 1e-6


class UniversalSpherical(TwoFrames):
    """Massless rod with a universal joint at frame_a and a ball joint at frame_b; connect bodies of the rod to frame_ia.

    Notes
    -----
    |r_b - r_a| = |r_rod_ia| is the only constraint. The first axis of the universal joint is n1_a, the second axis e2 is
    perpendicular to n1_a and to the rod e1: e1, e2 = n1 x e1 / |n1 x e1| and e1 x e2 are the axes of frame_ia, which adds no
    coordinates. No branch to frame_b: other parts hold it. No torque acts about n1 and e2.
    """

    n1_a: Any = structural(
        "first axis of the universal joint, resolved in frame_a",
        default=(0, 0, 1),
        shape=(3,),
        doc="Not parallel to the rod.",
    )
    r_rod_ia: Any = structural("from frame_a to frame_b, resolved in frame_ia, in m", default=(1, 0, 0), shape=(3,))
    frame_ia: Frame = port(Frame, "fixed to the rod at frame_a")
    r_rod_0: Vector3 = variable("from frame_a to frame_b, resolved in the world", unit="m")
    f_rod: Scalar = variable("force along the rod on frame_a, positive towards frame_b", unit="N")

    def check(self) -> None:
        """Reject a rod of length 0, and a rod parallel to the first axis."""
        require_direction(self, self.n1_a, "n1_a")
        require_direction(self, self.r_rod_ia, "r_rod_ia")
        if parallel(self.n1_a, self.r_rod_ia):
            raise DeclarationError("`n1_a` is parallel to the rod `r_rod_ia`; give another axis: n1_a=(0, 1, 0).")

    def connections(self):
        yield branch(self.frame_a, self.frame_ia)

    def equations(self):
        a, b, ia = self.frame_a, self.frame_b, self.frame_ia
        n1, length, r = unit_vector(self.n1_a), self._length(), self._rod()
        e1 = r / length
        e2 = cross(n1, e1) / norm(cross(n1, e1))
        R, f_b = self._orientation(e1, e2), resolve2(a.R, resolve1(b.R, b.f))
        yield self.r_rod_0 == b.r_0 - a.r_0
        yield dot(self.r_rod_0, self.r_rod_0) == length**2
        yield from move(a, ia, (0, 0, 0), R)
        yield a.f == -resolve1(R, ia.f) - f_b
        yield a.t == -resolve1(R, ia.t) - cross(r, f_b)
        yield b.t == (0, 0, 0)
        yield dot(n1, a.t) == 0
        yield dot(e2, a.t) == 0
        yield self.f_rod == -dot(e1, f_b)

    def _orientation(self, e1: Expr, e2: Expr) -> RelativeOrientation:
        """Orientation of frame_ia relative to frame_a, with w = (de2 . e3) e1 - (de1 . e3) e2 + (de1 . e2) e3."""
        e1_ia = unit_vector(self.r_rod_ia)
        e2_ia = unit_vector(np.cross(self.n1_a, e1_ia))
        e3_ia, e3 = np.cross(e1_ia, e2_ia), cross(e1, e2)
        n1, de1 = unit_vector(self.n1_a), der(self._rod()) / self._length()
        turning = dot(cross(n1, de1), e3) / norm(cross(n1, e1))  # de2 . e3
        T = outer_product(e1_ia, e1) + outer_product(e2_ia, e2) + outer_product(e3_ia, e3)
        return RelativeOrientation(T, e1_ia * turning - e2_ia * dot(de1, e3) + e3_ia * dot(de1, e2))

    def _rod(self) -> Expr:
        """From frame_a to frame_b, resolved in frame_a."""
        return resolve2(self.frame_a.R, self.frame_b.r_0 - self.frame_a.r_0)

    def _length(self) -> Any:
        return as_expr(float(np.linalg.norm(self.r_rod_ia)))

    def requirements(self):
        yield require(
            norm(cross(unit_vector(self.n1_a), self._rod())) > ALONG * self._length(),
            "the rod is parallel to n1_a at the start, a singular configuration of the universal joint; give another n1_a",
        )

    def shapes(self):
        """The rod, with a pin at one end and a ball at the other."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0)
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n1_a), style="pin")
        yield geometry.Axle(pose(self.frame_b), (0, 0, 1), style="ball")
