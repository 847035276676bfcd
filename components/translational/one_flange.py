"""OneFlange: base of drives."""

from __future__ import annotations

from acausal import Component, Scalar, der, port, structural, variable
from components.translational.flange import TranslationalFlange


class OneFlange(Component):
    """Base of drives with one rod end; the housing is fixed or has its own flange."""

    ends = ("flange", "flange")
    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    flange: TranslationalFlange = port(TranslationalFlange, "rod end")
    s: Scalar = variable("position of the flange relative to the support", unit="m")
    v: Scalar = variable("der(s)", unit="m/s")

    @port
    def support(self) -> TranslationalFlange | None:
        """Housing."""
        return TranslationalFlange() if self.use_support else None

    def equations(self):
        yield self.v == der(self.s)
        if self.use_support:
            yield self.s == self.flange.s - self.support.s
            yield self.support.f == -self.flange.f
        else:
            yield self.s == self.flange.s

    def supplied_power(self):
        """Power into the rod and the housing."""
        return -self.flange.f * self.v
