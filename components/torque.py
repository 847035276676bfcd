"""Torque: torque between two frames."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import torque_arrow
from components.load import NONE, FrameLoad


class Torque(FrameLoad):
    """Torque at frame_b; the opposite torque acts at frame_a."""

    torque: Vector3 = input("torque at frame_b, resolved in resolve_in_frame", unit="N.m")

    def load(self):
        """Torque without force."""
        return NONE, self.torque

    def shapes(self):
        """The torque at both frames."""
        yield from (torque_arrow(self.frame_b), torque_arrow(self.frame_a))
