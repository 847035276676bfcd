"""TranslationalEMF: ideal translational converter."""

from __future__ import annotations

from acausal import Scalar, der, parameter, port, structural, variable
from components.electrical.one_port import OnePort
from components.translational.flange import TranslationalFlange


class TranslationalEMF(OnePort):
    """Ideal conversion of electrical into mechanical power: v = k v_rel, force k i."""

    k: Scalar = parameter("transformation coefficient", unit="N/A", default=1)
    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    flange: TranslationalFlange = port(TranslationalFlange, "rod end")
    s: Scalar = variable("position of the flange relative to the support", unit="m")
    v_rel: Scalar = variable("der(s)", unit="m/s")

    @port
    def support(self) -> TranslationalFlange | None:
        """Housing."""
        return TranslationalFlange() if self.use_support else None

    def equations(self):
        yield from super().equations()
        yield self.s == self.flange.s - (self.support.s if self.use_support else 0)
        yield self.v_rel == der(self.s)
        yield self.v == self.k * self.v_rel
        yield self.flange.f == -self.k * self.i
        if self.use_support:
            yield self.support.f == -self.flange.f
