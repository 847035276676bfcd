"""RelSpeedSensor: measures the relative speed of two shaft ends."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.rotational.relative_sensor import RelativeSensor


class RelSpeedSensor(RelativeSensor):
    """Measures the speed of flange_b relative to flange_a."""

    w_rel: Scalar = output("der(phi_rel)", unit="rad/s")

    def measure(self):
        """Relative speed."""
        yield self.w_rel == der(self.phi_rel)
