"""SpeedSensor: measures the speed of a rod end."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.translational.absolute_sensor import AbsoluteSensor


class SpeedSensor(AbsoluteSensor):
    """Measures the absolute speed of a rod end."""

    v: Scalar = output("absolute speed of the flange", unit="m/s")

    def measure(self):
        """Speed."""
        yield self.v == der(self.flange.s)
