"""WorldTorque: external torque at a frame."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import torque_arrow
from components.load import NONE, WorldLoad


class WorldTorque(WorldLoad):
    """External torque at frame_b."""

    torque: Vector3 = input("torque, resolved in resolve_in_frame", unit="N.m")

    def load(self):
        """Torque without force."""
        return NONE, self.torque

    def shapes(self):
        """The torque."""
        yield torque_arrow(self.frame_b)
