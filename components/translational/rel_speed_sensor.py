"""RelSpeedSensor: measures the relative speed of two rod ends."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.translational.relative_sensor import RelativeSensor


class RelSpeedSensor(RelativeSensor):
    """Measures the speed of flange_b relative to flange_a."""

    v_rel: Scalar = output("der(s_rel)", unit="m/s")

    def measure(self):
        """Relative speed."""
        yield self.v_rel == der(self.s_rel)
