"""PowerSensor: measures the power through a shaft."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.rotational.cut_sensor import CutSensor


class PowerSensor(CutSensor):
    """Measures the power that flows from flange_a to flange_b."""

    power: Scalar = output("power from flange_a to flange_b", unit="W")

    def measure(self):
        """Cut torque times speed."""
        yield self.power == self.flange_a.tau * der(self.flange_a.phi)
