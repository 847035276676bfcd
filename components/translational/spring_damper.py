"""SpringDamper: spring and damper in parallel."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.thermal.heat_loss import HeatLoss
from components.translational.compliant import Compliant


class SpringDamper(HeatLoss, Compliant):
    """Linear spring and damper in parallel."""

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.s/m", minimum=0)
    s_rel0: Scalar = parameter("unstretched length", unit="m", default=0, doc="The spring force is 0 there.")

    def law(self):
        """Hooke's law, and a force proportional to the speed."""
        yield self.f == self.c * (self.s_rel - self.s_rel0) + self.d * self.v_rel

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.s_rel - self.s_rel0) ** 2 / 2

    def loss(self):
        """Power of the damper."""
        return self.d * self.v_rel**2
