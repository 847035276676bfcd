"""Damper: linear damper."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.thermal.heat_loss import HeatLoss
from components.translational.compliant import Compliant


class Damper(HeatLoss, Compliant):
    """Linear damper."""

    d: Scalar = parameter("damping constant", unit="N.s/m", minimum=0)

    def law(self):
        """Force proportional to the speed."""
        yield self.f == self.d * self.v_rel

    def loss(self):
        """Power of the force."""
        return self.d * self.v_rel**2
