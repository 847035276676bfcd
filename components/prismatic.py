"""Prismatic joint."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, Scalar, branch, cross, der, dot, port, structural, variable
from components.frame import TwoFrames, move
from components.orientation import null_rotation, unit_vector
from components.translational_flange import TranslationalFlange
from components.world import require_direction


class Prismatic(TwoFrames):
    """Prismatic joint: frame_b slides relative to frame_a along the axis n.

    Parameters
    ----------
    n : array of 3 floats
        Axis of translation, the same in frame_a and frame_b; any length but 0.
    use_axis_flange : bool
        True gives the joint a drive rod `axis` and its housing `support`.
    """

    n: Any = structural("axis of translation, the same in frame_a and frame_b", default=(1, 0, 0), shape=(3,))
    use_axis_flange: bool = structural("whether the joint has a drive rod", default=False, choices=(True, False))
    s: Scalar = variable("distance from frame_a to frame_b along n", unit="m", select=PREFER)
    v: Scalar = variable("der(s)", unit="m/s", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")
    f: Scalar = variable("drive force along n", unit="N")

    @port
    def axis(self):
        """Drive rod."""
        return TranslationalFlange() if self.use_axis_flange else None

    @port
    def support(self):
        """Housing of the drive."""
        return TranslationalFlange() if self.use_axis_flange else None

    def check(self) -> None:
        """Refuse an axis of length 0."""
        require_direction(self, self.n, "n")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        n = unit_vector(self.n)
        r = n * self.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield from move(self.frame_a, self.frame_b, r, null_rotation())
        yield self.frame_a.f == -self.frame_b.f
        yield self.frame_a.t == -self.frame_b.t - cross(r, self.frame_b.f)
        yield self.f == -dot(n, self.frame_b.f)
        if self.use_axis_flange:
            yield self.axis.s == self.s
            yield self.axis.f == self.f
            yield self.support.s == 0
        else:
            yield self.f == 0
