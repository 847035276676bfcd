"""SpeedSensor: measures the speed of a shaft end."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.rotational.absolute_sensor import AbsoluteSensor


class SpeedSensor(AbsoluteSensor):
    """Measures the absolute speed of a shaft end."""

    w: Scalar = output("absolute speed of the flange", unit="rad/s")

    def measure(self):
        """Speed."""
        yield self.w == der(self.flange.phi)
