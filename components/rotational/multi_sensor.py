"""MultiSensor: measures speed, torque and power of a shaft."""

from __future__ import annotations

from acausal import Scalar, der, output
from components.rotational.cut_sensor import CutSensor


class MultiSensor(CutSensor):
    """Measures the speed of a shaft, the torque in it and the power through it."""

    w: Scalar = output("absolute speed of the flanges", unit="rad/s")
    tau: Scalar = output("cut torque, flange_a.tau: positive if it accelerates flange_a forwards", unit="N.m")
    power: Scalar = output("power from flange_a to flange_b", unit="W")

    def measure(self):
        """Speed, cut torque and their product."""
        yield self.w == der(self.flange_a.phi)
        yield self.tau == self.flange_a.tau
        yield self.power == self.tau * self.w
