"""FixedRotation: a massless bent rod between two frames."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, branch, cross, parameter, structural
from components.frame import TwoFrames, move
from components.orientation import axis_rotation, fixed_rotation, resolve1, unit_vector
from components.world import require_direction


class FixedRotation(TwoFrames):
    """Frame_b is fixed at r from frame_a and turned by a constant angle about n."""

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m", default=(0, 0, 0))
    n: Any = structural(
        "axis of rotation, the same in frame_a and frame_b", default=(1, 0, 0), shape=(3,), doc="Any length but 0."
    )
    angle: Any = structural("angle of rotation about n, in rad", default=0.0, shape=(), doc="From frame_a to frame_b.")

    def check(self) -> None:
        """Refuse an axis of length 0."""
        require_direction(self, self.n, "n")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        R = fixed_rotation(axis_rotation(unit_vector(self.n), float(self.angle)))
        f_b, t_b = resolve1(R, b.f), resolve1(R, b.t)
        yield from move(a, b, self.r, R)
        yield a.f + f_b == (0, 0, 0)
        yield a.t + t_b + cross(self.r, f_b) == (0, 0, 0)
