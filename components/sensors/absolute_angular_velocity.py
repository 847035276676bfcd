"""AbsoluteAngularVelocity: measures the angular velocity of a frame."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, output
from components.orientation import resolve1
from components.sensors.one_frame_sensor import OneFrameSensor, resolved


def absolute_angular_velocity(frame: Any, resolving: Any = None) -> Any:
    """Angular velocity of a frame, resolved in the frame `resolving` or in the world, in rad/s."""
    return resolved(resolve1(frame.R, frame.R.w), resolving)


class AbsoluteAngularVelocity(OneFrameSensor):
    """Measures the angular velocity of frame_a."""

    w: Vector3 = output("angular velocity of frame_a, resolved in resolve_in_frame", unit="rad/s")

    def measure(self):
        """Angular velocity."""
        yield self.w == absolute_angular_velocity(self.frame_a, self.resolving)
