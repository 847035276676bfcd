"""PowerSensor: measures the power through a rod."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.translational.cut_sensor import CutSensor


class PowerSensor(CutSensor):
    """Measures the power that flows from flange_a to flange_b."""

    power: Scalar = output("power from flange_a to flange_b", unit="W")

    def measure(self):
        """Cut force times speed."""
        yield self.power == self.flange_a.f * der(self.flange_a.s)
