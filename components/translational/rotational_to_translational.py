"""RotationalToTranslational: base of gears between a shaft and a rod."""

from __future__ import annotations

from acausal import Component, Expr, Scalar, port, structural, variable
from components.flange import Flange
from components.translational.flange import TranslationalFlange


class RotationalToTranslational(Component):
    """Base of ideal gears from rotation to translation; a subclass defines transmission_ratio()."""

    ends = ("flange_r", "flange_t")
    use_support_r: bool = structural(
        "whether the housing of the shaft has a flange `support_r`", default=False, choices=(True, False)
    )
    use_support_t: bool = structural(
        "whether the housing of the rod has a flange `support_t`", default=False, choices=(True, False)
    )
    flange_r: Flange = port(Flange, "shaft end")
    flange_t: TranslationalFlange = port(TranslationalFlange, "rod end")
    phi: Scalar = variable("angle of flange_r relative to its support", unit="rad")
    s: Scalar = variable("position of flange_t relative to its support", unit="m")

    @port
    def support_r(self) -> Flange | None:
        """Housing of the shaft."""
        return Flange() if self.use_support_r else None

    @port
    def support_t(self) -> TranslationalFlange | None:
        """Housing of the rod."""
        return TranslationalFlange() if self.use_support_t else None

    def equations(self):
        ratio = self.transmission_ratio()
        yield self.phi == self.flange_r.phi - (self.support_r.phi if self.use_support_r else 0)
        yield self.s == self.flange_t.s - (self.support_t.s if self.use_support_t else 0)
        yield self.phi == ratio * self.s
        yield ratio * self.flange_r.tau + self.flange_t.f == 0
        if self.use_support_r:
            yield self.support_r.tau == -self.flange_r.tau
        if self.use_support_t:
            yield self.support_t.f == -self.flange_t.f

    def transmission_ratio(self) -> Expr:
        """Return the angle of the shaft over the displacement of the rod, in rad/m."""
        raise NotImplementedError("returns the ratio phi / s", "return ...")
