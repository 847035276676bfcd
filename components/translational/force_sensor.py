"""ForceSensor: measures the force in a rod."""

from __future__ import annotations

from acausal import Scalar, output
from components.translational.cut_sensor import CutSensor


class ForceSensor(CutSensor):
    """Measures the force in a rod."""

    f: Scalar = output("cut force, flange_a.f: positive in compression", unit="N")

    def measure(self):
        """Cut force."""
        yield self.f == self.flange_a.f
