"""ShaftFriction: base of dry friction between a shaft and its housing."""

from __future__ import annotations

from acausal import Expr, Scalar, der, discrete, port, quantity, sign, structural, variable
from components.dry_friction import MODE, SLIP, STUCK, DryFriction
from components.flange import Flange, TwoFlanges


class ShaftFriction(DryFriction, TwoFlanges):
    """Base of dry friction between a rigid massless shaft and its housing, which is fixed or has its own flange."""

    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    phi: Scalar = variable("angle of the shaft relative to the support", unit="rad")
    w: Scalar = variable("der(phi)", unit="rad/s")
    a: Scalar = variable("der(w)", unit="rad/s2")
    tau: Scalar = variable("friction torque opposing w", unit="N.m")
    mode: Scalar = discrete(MODE, unit="1", start=sign(w))
    w_stuck: Scalar = discrete(STUCK, unit="rad/s")
    w_slip: Scalar = discrete(SLIP, unit="rad/s")

    @port
    def support(self) -> Flange | None:
        """Housing."""
        return Flange() if self.use_support else None

    def equations(self):
        yield from super().equations()
        yield self.phi == self.flange_a.phi - (self.support.phi if self.use_support else 0)
        yield self.flange_b.phi == self.flange_a.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.flange_a.tau + self.flange_b.tau == self.tau
        if self.use_support:
            yield self.support.tau == -self.tau
        yield from self.stick_slip(self.w, self.tau, quantity(1.0, "kg.m2"), self.w_stuck, self.w_slip)

    def loss(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w

    def sliding_speed(self) -> Expr:
        """Magnitude of the shaft speed during sliding."""
        return self.mode * self.w
