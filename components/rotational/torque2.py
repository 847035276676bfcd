"""Torque2: torque between two shaft ends."""

from __future__ import annotations

from acausal import Scalar, der, input
from components.flange import TwoFlanges


class Torque2(TwoFlanges):
    """Torque on the shaft at flange_b; the opposite torque acts at flange_a."""

    tau: Scalar = input("torque on the shaft at flange_b", unit="N.m")

    def equations(self):
        yield self.flange_a.tau == self.tau
        yield self.flange_b.tau == -self.tau

    def supplied_power(self):
        """Power of the torque."""
        return self.tau * der(self.flange_b.phi - self.flange_a.phi)
