"""RelativeAngularVelocity: measures the relative angular velocity of two frames."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, output
from components.orientation import resolve1
from components.sensors.one_frame_sensor import resolved
from components.sensors.two_frame_sensor import TwoFrameSensor


def relative_angular_velocity(frame_a: Any, frame_b: Any, resolving: Any = None) -> Any:
    """Angular velocity of frame_b relative to frame_a, resolved in the frame `resolving` or in the world, in rad/s."""
    return resolved(resolve1(frame_b.R, frame_b.R.w) - resolve1(frame_a.R, frame_a.R.w), resolving)


class RelativeAngularVelocity(TwoFrameSensor):
    """Measures the angular velocity of frame_b relative to frame_a."""

    w_rel: Vector3 = output("relative angular velocity of frame_b, resolved in resolve_in_frame", unit="rad/s")

    def measure(self):
        """Relative angular velocity."""
        yield self.w_rel == relative_angular_velocity(self.frame_a, self.frame_b, self.resolving)
