"""FreeMotion: joint with six degrees of freedom."""

from __future__ import annotations

from acausal import PREFER, Vector3, der, variable
from components.frame import move
from components.orientation import RelativeOrientation, from_quaternion, quaternion_equations, resolve1
from components.spherical import Spherical


class FreeMotion(Spherical):
    """Joint with six degrees of freedom: the motion of frame_b relative to frame_a is the state.

    Notes
    -----
    The states are r_rel_a, v_rel_a, a quaternion, which has no singular orientation, and w_rel.
    """

    r_rel_a: Vector3 = variable("position of frame_b relative to frame_a, resolved in frame_a", unit="m", select=PREFER)
    v_rel_a: Vector3 = variable("der(r_rel_a)", unit="m/s", select=PREFER)
    a_rel_a: Vector3 = variable("der(v_rel_a)", unit="m/s2")

    def equations(self):
        R = RelativeOrientation(from_quaternion(self.Q).T, self.w_rel)
        yield from quaternion_equations(self.Q, self.w_rel)
        yield self.z_rel == der(self.w_rel)
        yield self.w_rel_a == resolve1(R, self.w_rel)
        yield self.v_rel_a == der(self.r_rel_a)
        yield self.a_rel_a == der(self.v_rel_a)
        yield from move(self.frame_a, self.frame_b, self.r_rel_a, R)
        for frame in (self.frame_a, self.frame_b):
            yield frame.f == (0, 0, 0)
            yield frame.t == (0, 0, 0)

    def shapes(self):
        """No shape: the part has no size."""
        yield from ()
