"""Force: force between two frames."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import force_arrow, torque_arrow
from components.load import NONE, FrameLoad


class Force(FrameLoad):
    """Force at the origin of frame_b; the opposite force acts on frame_a along the same line of action."""

    force: Vector3 = input("force at frame_b, resolved in resolve_in_frame", unit="N")

    def load(self):
        """Force without torque."""
        return self.force, NONE

    def shapes(self):
        """The force, and its reaction at frame_a."""
        yield from (force_arrow(self.frame_b), force_arrow(self.frame_a), torque_arrow(self.frame_a))
