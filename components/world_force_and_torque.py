"""WorldForceAndTorque: external force and torque at a frame."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import force_arrow, torque_arrow
from components.load import WorldLoad


class WorldForceAndTorque(WorldLoad):
    """External force and torque at frame_b."""

    force: Vector3 = input("force, resolved in resolve_in_frame", unit="N")
    torque: Vector3 = input("torque, resolved in resolve_in_frame", unit="N.m")

    def load(self):
        """Force and torque."""
        return self.force, self.torque

    def shapes(self):
        """Force and torque."""
        yield from (force_arrow(self.frame_b), torque_arrow(self.frame_b))
