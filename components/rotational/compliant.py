"""Compliant: base of torques between two shaft ends."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, der, variable
from components.flange import TwoFlanges


class Compliant(TwoFlanges):
    """Base of torques that depend on the relative angle; a subclass defines tau."""

    phi_rel: Scalar = variable("angle from flange_a to flange_b", unit="rad")
    w_rel: Scalar = variable("der(phi_rel)", unit="rad/s")
    a_rel: Scalar = variable("der(w_rel)", unit="rad/s2")
    tau: Scalar = variable("torque between the flanges, flange_b.tau", unit="N.m")

    def equations(self):
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
        yield self.flange_b.tau == self.tau
        yield self.flange_a.tau == -self.tau
        yield from self.law()

    def law(self) -> Any:
        """Yield the equation of tau."""
        raise NotImplementedError("yields the equation of the torque tau", "yield self.tau == ...")
