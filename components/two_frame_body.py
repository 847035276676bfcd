"""TwoFrameBody: base of rigid bodies with two frames."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, connect, effect, part, require, structural, variable
from components.body import Body
from components.frame import TwoFrames
from components.rigid import wrong_inertia
from components.translation import FixedTranslation


class TwoFrameBody(TwoFrames):
    """Base of rigid bodies with frame_a and, at r from it, frame_b; a subclass declares r, m, r_CM and I."""

    angles_start: Any = structural(
        "angles at the start",
        default=(0, 0, 0),
        shape=(3,),
        doc="In rad; the orientation of a freely moving body, as of Body.",
    )
    sequence_start: Any = structural("axes of these angles", default=(1, 2, 3), shape=(3,))
    angles_fixed: bool = structural("whether the angles hold at the start", default=False, choices=(True, False))
    gyroscopic: bool = effect("gyroscopic torque w x I w", default=True, doc="False leaves it out, as of Body.")
    r_0: Vector3 = variable("position of frame_a, resolved in the world", unit="m")
    v_0: Vector3 = variable("der(r_0), resolved in the world", unit="m/s")
    a_0: Vector3 = variable("der(v_0), resolved in the world", unit="m/s2")
    w_a: Vector3 = variable("angular velocity, resolved in frame_a", unit="rad/s")
    z_a: Vector3 = variable("angular acceleration, resolved in frame_a", unit="rad/s2")
    r: Any
    m: Any
    r_CM: Any
    I: Any

    @part
    def frame_translation(self):
        """From frame_a to frame_b."""
        return FixedTranslation(r=self.r)

    @part
    def body(self):
        """Mass and inertia."""
        return Body(
            m=self.m,
            r_CM=self.r_CM,
            I=self.I,
            angles_start=self.angles_start,
            sequence_start=self.sequence_start,
            angles_fixed=self.angles_fixed,
            gyroscopic=self.gyroscopic,
        )

    def connections(self):
        yield connect(self.frame_a, self.body.frame_a)
        yield connect(self.frame_a, self.frame_translation.frame_a)
        yield connect(self.frame_translation.frame_b, self.frame_b)

    def requirements(self):
        yield require(self.I, wrong_inertia)

    def equations(self):
        for name in ("r_0", "v_0", "a_0", "w_a", "z_a"):
            yield getattr(self, name) == getattr(self.body, name)
