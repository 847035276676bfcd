"""Cylindrical joint."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, Scalar, branch, cross, der, dot, geometry, structural, variable
from components.frame import TwoFrames, move, pose
from components.orientation import planar_rotation, resolve1, unit_vector
from components.world import require_direction


class Cylindrical(TwoFrames):
    """Cylindrical joint: frame_b slides along the axis n and rotates about it relative to frame_a."""

    n: Any = structural(
        "axis of the joint, the same in frame_a and frame_b", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    s: Scalar = variable("distance from frame_a to frame_b along n", unit="m", select=PREFER)
    phi: Scalar = variable("angle from frame_a to frame_b", unit="rad", select=PREFER)
    v: Scalar = variable("der(s)", unit="m/s", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")
    wd: Scalar = variable("der(w)", unit="rad/s2")

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        n = unit_vector(self.n)
        r, R = n * self.s, planar_rotation(n, self.phi)
        f_b = resolve1(R, self.frame_b.f)
        yield self.v == der(self.s)
        yield self.w == der(self.phi)
        yield self.a == der(self.v)
        yield self.wd == der(self.w)
        yield from move(self.frame_a, self.frame_b, r, R)
        yield self.frame_a.f == -f_b
        yield self.frame_a.t == -resolve1(R, self.frame_b.t) - cross(r, f_b)
        yield dot(n, self.frame_b.f) == 0
        yield dot(n, self.frame_b.t) == 0

    def shapes(self):
        """A shaft and a sleeve on it."""
        n = unit_vector(self.n)
        yield geometry.Rail(pose(self.frame_a), n, self.frame_b.r_0, "shaft")
        yield geometry.Axle(pose(self.frame_b), n, style="sleeve")
