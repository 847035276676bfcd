"""TwoFlangesAndSupport: base of parts in a housing."""

from __future__ import annotations

from acausal import Scalar, port, structural, variable
from components.flange import Flange, TwoFlanges


class TwoFlangesAndSupport(TwoFlanges):
    """Base of parts with two shaft ends in a housing, which is fixed or has its own flange."""

    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    phi_a: Scalar = variable("angle of flange_a relative to the support", unit="rad")
    phi_b: Scalar = variable("angle of flange_b relative to the support", unit="rad")

    @port
    def support(self) -> Flange | None:
        """Housing."""
        return Flange() if self.use_support else None

    def equations(self):
        phi_support = self.support.phi if self.use_support else 0
        yield self.phi_a == self.flange_a.phi - phi_support
        yield self.phi_b == self.flange_b.phi - phi_support
        if self.use_support:
            yield self.support.tau == -self.flange_a.tau - self.flange_b.tau
