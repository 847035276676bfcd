"""TwoFrameBody: base of rigid bodies with two frames."""

from __future__ import annotations

from typing import Any

from acausal import connect, effect, part, require
from components.body import Body
from components.fixed_translation import FixedTranslation
from components.frame import TwoFrames
from components.moving_body import MovingBody
from components.rigid import unusual_inertia, wrong_inertia


class TwoFrameBody(TwoFrames, MovingBody):
    """Base of rigid bodies with frame_b at r from frame_a; a subclass declares r, m, r_CM and I."""

    gyroscopic: bool = effect("gyroscopic torque w x I w", default=True, doc="False omits it, as in Body.")
    r: Any
    m: Any
    r_CM: Any
    I: Any

    @part
    def frame_translation(self):
        """Rigid connection of frame_a and frame_b."""
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
            T_start=self.T_start,
            w_0_start=self.w_0_start,
            w_0_fixed=self.w_0_fixed,
            gyroscopic=self.gyroscopic,
        )

    def connections(self):
        yield connect(self.frame_a, self.body.frame_a)
        yield connect(self.frame_a, self.frame_translation.frame_a)
        yield connect(self.frame_translation.frame_b, self.frame_b)

    def shapes(self):
        """A rod between the frames, and the centre of mass."""
        yield from (*self.frame_translation.shapes(), *self.body.shapes())

    def requirements(self):
        yield require(self.I, wrong_inertia)
        yield require(self.I, unusual_inertia, warning=True)

    def equations(self):
        for name in ("r_0", "v_0", "a_0", "w_a", "z_a"):
            yield getattr(self, name) == getattr(self.body, name)
