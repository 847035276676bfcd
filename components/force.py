"""Force: a force between two frames."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import force_arrow, torque_arrow
from components.load import NONE, FrameLoad


class Force(FrameLoad):
    """Force that acts at the origin of frame_b, and in the opposite sense, on the same line, on frame_a."""

    force: Vector3 = input("force at frame_b, resolved in resolve_in_frame", unit="N")

    def load(self):
        """Force alone."""
        return self.force, NONE

    def shapes(self):
        """The force, and what it is in frame_a."""
        yield from (force_arrow(self.frame_b), force_arrow(self.frame_a), torque_arrow(self.frame_a))
