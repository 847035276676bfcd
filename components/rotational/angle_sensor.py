"""AngleSensor: measures the angle of a shaft end."""

from __future__ import annotations

from acausal import Scalar, output
from components.rotational.absolute_sensor import AbsoluteSensor


class AngleSensor(AbsoluteSensor):
    """Measures the absolute angle of a shaft end."""

    phi: Scalar = output("absolute angle of the flange", unit="rad")

    def measure(self):
        """Angle."""
        yield self.phi == self.flange.phi
