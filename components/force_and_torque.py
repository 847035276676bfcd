"""ForceAndTorque: force and torque between two frames."""

from __future__ import annotations

from acausal import Vector3, input
from components.frame import force_arrow, torque_arrow
from components.load import FrameLoad


class ForceAndTorque(FrameLoad):
    """Force and torque at frame_b; the opposite load acts on frame_a along the same line of action."""

    force: Vector3 = input("force at frame_b, resolved in resolve_in_frame", unit="N")
    torque: Vector3 = input("torque at frame_b, resolved in resolve_in_frame", unit="N.m")

    def load(self):
        """Force and torque."""
        return self.force, self.torque

    def shapes(self):
        """Force and torque at both frames."""
        for frame in (self.frame_b, self.frame_a):
            yield from (force_arrow(frame), torque_arrow(frame))
