"""Damper: linear torsional damper."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.rotational.compliant import Compliant
from components.thermal.heat_loss import HeatLoss


class Damper(HeatLoss, Compliant):
    """Linear torsional damper."""

    d: Scalar = parameter("damping constant", unit="N.m.s/rad", minimum=0)

    def law(self):
        """Torque proportional to the speed."""
        yield self.tau == self.d * self.w_rel

    def loss(self):
        """Power of the torque."""
        return self.d * self.w_rel**2
