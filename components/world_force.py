"""WorldForce: external force at a frame."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import force_arrow
from components.load import NONE, WorldLoad


class WorldForce(WorldLoad):
    """External force at the origin of frame_b."""

    force: Vector3 = input("force, resolved in resolve_in_frame", unit="N")

    def load(self):
        """Force without torque."""
        return self.force, NONE

    def shapes(self):
        """The force."""
        yield force_arrow(self.frame_b)
