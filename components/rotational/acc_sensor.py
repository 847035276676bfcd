"""AccSensor: measures the acceleration of a shaft end."""

from __future__ import annotations

from acausal import Scalar, der, output, variable
from components.rotational.absolute_sensor import AbsoluteSensor


class AccSensor(AbsoluteSensor):
    """Measures the absolute acceleration of a shaft end."""

    w: Scalar = variable("absolute speed of the flange", unit="rad/s")
    a: Scalar = output("absolute acceleration of the flange", unit="rad/s2")

    def measure(self):
        """Acceleration."""
        yield self.w == der(self.flange.phi)
        yield self.a == der(self.w)
