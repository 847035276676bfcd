"""AbsolutePosition: measures the position of a frame."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, output
from components.sensors.one_frame_sensor import OneFrameSensor, resolved


def absolute_position(frame: Any, resolving: Any = None) -> Any:
    """Position of the origin of a frame, resolved in the frame `resolving` or in the world, in m."""
    return resolved(frame.r_0, resolving)


class AbsolutePosition(OneFrameSensor):
    """Measures the position of the origin of frame_a."""

    r: Vector3 = output("position of frame_a, resolved in resolve_in_frame", unit="m")

    def measure(self):
        """Position."""
        yield self.r == absolute_position(self.frame_a, self.resolving)
