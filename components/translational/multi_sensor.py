"""MultiSensor: measures speed, force and power of a rod."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.translational.cut_sensor import CutSensor


class MultiSensor(CutSensor):
    """Measures the speed of a rod, the force in it and the power through it."""

    v: Scalar = output("absolute speed of the flanges", unit="m/s")
    f: Scalar = output("cut force, flange_a.f: positive in compression", unit="N")
    power: Scalar = output("power from flange_a to flange_b", unit="W")

    def measure(self):
        """Speed, cut force and their product."""
        yield self.v == der(self.flange_a.s)
        yield self.f == self.flange_a.f
        yield self.power == self.f * self.v
