"""TorqueSensor: measures the torque in a shaft."""

from __future__ import annotations

from acausal import Scalar, output
from components.rotational.cut_sensor import CutSensor


class TorqueSensor(CutSensor):
    """Measures the torque in a shaft."""

    tau: Scalar = output("cut torque, flange_a.tau: positive if it accelerates flange_a forwards", unit="N.m")

    def measure(self):
        """Cut torque."""
        yield self.tau == self.flange_a.tau
