"""AbsoluteVelocity: measures the velocity of a frame."""

from __future__ import annotations

from typing import Any

from acausal import Vector3, output
from components.orientation import resolve1
from components.sensors.one_frame_sensor import OneFrameSensor, resolved


def absolute_velocity(frame: Any, resolving: Any = None) -> Any:
    """Velocity of the origin of a frame, resolved in the frame `resolving` or in the world, in m/s."""
    return resolved(resolve1(frame.R, frame.v), resolving)


class AbsoluteVelocity(OneFrameSensor):
    """Measures the velocity of the origin of frame_a."""

    v: Vector3 = output("velocity of frame_a, resolved in resolve_in_frame", unit="m/s")

    def measure(self):
        """Velocity."""
        yield self.v == absolute_velocity(self.frame_a, self.resolving)
