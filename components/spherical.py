"""Spherical joint."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import PREFER, Vector3, branch, der, geometry, structural, variable
from components.frame import TwoFrames, move, pose
from components.orientation import (
    RelativeOrientation,
    axes_rotations,
    from_quaternion,
    quaternion_equations,
    quaternion_of,
    resolve1,
)


class Spherical(TwoFrames):
    """Spherical joint: the origins coincide, frame_b rotates freely relative to frame_a.

    Notes
    -----
    The states are a quaternion, which has no singular orientation, and w_rel.
    """

    start_words: ClassVar[dict[str, str]] = {"Q": "angles_fixed=True"}
    angles_start: Any = structural(
        "initial angles, in rad",
        default=(0, 0, 0),
        shape=(3,),
        doc="Orientation of frame_b relative to frame_a.",
    )
    sequence_start: Any = structural("axes of these angles", default=(1, 2, 3), shape=(3,), choices=(1, 2, 3))
    angles_fixed: bool = structural("whether the initial angles are fixed", default=False, choices=(True, False))
    Q_start: Any = structural(
        "quaternion of these angles",
        default=lambda s: quaternion_of(axes_rotations(s.sequence_start, s.angles_start)),
        shape=(4,),
        doc="Vector part, scalar part; computed from the angles if not given.",
    )
    Q: Any = variable("quaternion from frame_a to frame_b", shape=(4,), start=Q_start, select=PREFER)
    w_rel: Vector3 = variable("relative angular velocity, resolved in frame_b", unit="rad/s", select=PREFER)
    z_rel: Vector3 = variable("der(w_rel)", unit="rad/s2")
    w_rel_a: Vector3 = variable("relative angular velocity, resolved in frame_a", unit="rad/s")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        R = RelativeOrientation(from_quaternion(self.Q).T, self.w_rel)
        yield from quaternion_equations(self.Q, self.w_rel)
        yield self.z_rel == der(self.w_rel)
        yield self.w_rel_a == resolve1(R, self.w_rel)
        yield from move(self.frame_a, self.frame_b, (0, 0, 0), R)
        yield self.frame_a.f == -resolve1(R, self.frame_b.f)
        yield self.frame_a.t == (0, 0, 0)
        yield self.frame_b.t == (0, 0, 0)

    def shapes(self):
        """A ball."""
        yield geometry.Axle(pose(self.frame_a), (0, 0, 1), style="ball")

    def initial_equations(self):
        if self.angles_fixed:
            yield self.Q_start == self.Q
        else:
            yield self.Q @ self.Q == 1
