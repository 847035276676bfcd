"""RelativeVelocity: measures the relative velocity of two frames."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, cross, output
from components.orientation import resolve1, resolve2
from components.sensors.one_frame_sensor import resolved
from components.sensors.two_frame_sensor import TwoFrameSensor


def relative_velocity(frame_a: Any, frame_b: Any, resolving: Any = None) -> Any:
    """Velocity of frame_b relative to the rotating frame_a, resolved in the frame `resolving` or in the world, in m/s."""
    a, b = frame_a, frame_b
    carried = a.v + cross(a.R.w, resolve2(a.R, b.r_0 - a.r_0))
    return resolved(resolve1(b.R, b.v) - resolve1(a.R, carried), resolving)


class RelativeVelocity(TwoFrameSensor):
    """Measures the velocity of the origin of frame_b relative to frame_a."""

    v_rel: Vector3 = output("velocity of frame_b relative to frame_a, resolved in resolve_in_frame", unit="m/s")

    def measure(self):
        """Relative velocity."""
        yield self.v_rel == relative_velocity(self.frame_a, self.frame_b, self.resolving)
