"""AccSensor: measures the acceleration of a rod end."""

from __future__ import annotations

from acausal import Scalar, der, output, variable
from components.translational.absolute_sensor import AbsoluteSensor


class AccSensor(AbsoluteSensor):
    """Measures the absolute acceleration of a rod end."""

    v: Scalar = variable("absolute speed of the flange", unit="m/s")
    a: Scalar = output("absolute acceleration of the flange", unit="m/s2")

    def measure(self):
        """Acceleration."""
        yield self.v == der(self.flange.s)
        yield self.a == der(self.v)
