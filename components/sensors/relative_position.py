"""RelativePosition: measures the relative position of two frames."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, output
from components.sensors.one_frame_sensor import resolved
from components.sensors.two_frame_sensor import TwoFrameSensor


def relative_position(frame_a: Any, frame_b: Any, resolving: Any = None) -> Any:
    """Position of frame_b relative to frame_a, resolved in the frame `resolving` or in the world, in m."""
    return resolved(frame_b.r_0 - frame_a.r_0, resolving)


class RelativePosition(TwoFrameSensor):
    """Measures the position of the origin of frame_b relative to that of frame_a."""

    r_rel: Vector3 = output("relative position of frame_b, resolved in resolve_in_frame", unit="m")

    def measure(self):
        """Relative position."""
        yield self.r_rel == relative_position(self.frame_a, self.frame_b, self.resolving)
