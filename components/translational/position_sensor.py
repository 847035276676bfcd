"""PositionSensor: measures the position of a rod end."""

from __future__ import annotations

from acausal import Scalar, output
from components.translational.absolute_sensor import AbsoluteSensor


class PositionSensor(AbsoluteSensor):
    """Measures the absolute position of a rod end."""

    s: Scalar = output("absolute position of the flange", unit="m")

    def measure(self):
        """Position."""
        yield self.s == self.flange.s
