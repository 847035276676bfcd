"""Spring: linear torsional spring."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.rotational.compliant import Compliant


class Spring(Compliant):
    """Linear torsional spring."""

    c: Scalar = parameter("spring constant", unit="N.m/rad", minimum=0)
    phi_rel0: Scalar = parameter("unstretched relative angle", unit="rad", default=0, doc="The torque is 0 there.")

    def law(self):
        """Hooke's law."""
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0)

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.phi_rel - self.phi_rel0) ** 2 / 2
