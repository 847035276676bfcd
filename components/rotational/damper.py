"""Damper: a linear torsional damper."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.rotational.compliant import Compliant


class Damper(Compliant):
    """Linear torsional damper."""

    d: Scalar = parameter("damping constant", unit="N.m.s/rad", minimum=0)

    def law(self):
        """Torque proportional to the speed."""
        yield self.tau == self.d * self.w_rel

    def dissipated_power(self):
        """Power of the torque."""
        return self.d * self.w_rel**2
