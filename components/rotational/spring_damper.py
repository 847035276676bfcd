"""SpringDamper: torsional spring and damper in parallel."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.rotational.compliant import Compliant
from components.thermal.heat_loss import HeatLoss


class SpringDamper(HeatLoss, Compliant):
    """Linear torsional spring and damper in parallel."""

    c: Scalar = parameter("spring constant", unit="N.m/rad", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.m.s/rad", minimum=0)
    phi_rel0: Scalar = parameter(
        "unstretched relative angle", unit="rad", default=0, doc="The spring torque is 0 there."
    )

    def law(self):
        """Hooke's law, and a torque proportional to the speed."""
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.phi_rel - self.phi_rel0) ** 2 / 2

    def loss(self):
        """Power of the damper."""
        return self.d * self.w_rel**2
