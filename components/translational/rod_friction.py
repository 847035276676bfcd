"""RodFriction: base of dry friction between a rod and its housing."""

from __future__ import annotations

from acausal import Expr, Scalar, der, discrete, port, quantity, sign, structural, variable
from components.dry_friction import MODE, SLIP, STUCK, DryFriction
from components.translational.flange import TranslationalFlange, TwoFlanges


class RodFriction(DryFriction, TwoFlanges):
    """Base of dry friction between a rigid massless rod and its housing, which is fixed or has its own flange."""

    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    s: Scalar = variable("position of the rod relative to the support", unit="m")
    v: Scalar = variable("der(s)", unit="m/s")
    a: Scalar = variable("der(v)", unit="m/s2")
    f: Scalar = variable("friction force opposing v", unit="N")
    mode: Scalar = discrete(MODE, unit="1", start=sign(v))
    v_stuck: Scalar = discrete(STUCK, unit="m/s")
    v_slip: Scalar = discrete(SLIP, unit="m/s")

    @port
    def support(self) -> TranslationalFlange | None:
        """Housing."""
        return TranslationalFlange() if self.use_support else None

    def equations(self):
        yield from super().equations()
        yield self.s == self.flange_a.s - (self.support.s if self.use_support else 0)
        yield self.flange_b.s == self.flange_a.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.flange_a.f + self.flange_b.f == self.f
        if self.use_support:
            yield self.support.f == -self.f
        yield from self.stick_slip(self.v, self.f, quantity(1.0, "kg"), self.v_stuck, self.v_slip)

    def loss(self) -> Expr:
        """Power of the force."""
        return self.f * self.v

    def sliding_speed(self) -> Expr:
        """Magnitude of the rod speed during sliding."""
        return self.mode * self.v
