"""RelAccSensor: measures the relative acceleration of two rod ends."""

from __future__ import annotations

from acausal import Scalar, der, output, variable
from components.translational.relative_sensor import RelativeSensor


class RelAccSensor(RelativeSensor):
    """Measures the acceleration of flange_b relative to flange_a."""

    v_rel: Scalar = variable("der(s_rel)", unit="m/s")
    a_rel: Scalar = output("der(v_rel)", unit="m/s2")

    def measure(self):
        """Relative acceleration."""
        yield self.v_rel == der(self.s_rel)
        yield self.a_rel == der(self.v_rel)
