"""RelAccSensor: measures the relative acceleration of two shaft ends."""

from __future__ import annotations

from acausal import Scalar, der, output, variable
from components.rotational.relative_sensor import RelativeSensor


class RelAccSensor(RelativeSensor):
    """Measures the acceleration of flange_b relative to flange_a."""

    w_rel: Scalar = variable("der(phi_rel)", unit="rad/s")
    a_rel: Scalar = output("der(w_rel)", unit="rad/s2")

    def measure(self):
        """Relative acceleration."""
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
