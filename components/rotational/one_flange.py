"""OneFlange: base of drives."""

from __future__ import annotations

from acausal import Component, Scalar, der, port, structural, variable
from components.flange import Flange


class OneFlange(Component):
    """Base of drives with one shaft end; the housing is fixed or has its own flange."""

    ends = ("flange", "flange")
    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    flange: Flange = port(Flange, "shaft end")
    phi: Scalar = variable("angle of the flange relative to the support", unit="rad")
    w: Scalar = variable("der(phi)", unit="rad/s")

    @port
    def support(self) -> Flange | None:
        """Housing."""
        return Flange() if self.use_support else None

    def equations(self):
        yield self.w == der(self.phi)
        if self.use_support:
            yield self.phi == self.flange.phi - self.support.phi
            yield self.support.tau == -self.flange.tau
        else:
            yield self.phi == self.flange.phi

    def supplied_power(self):
        """Power into the shaft and the housing."""
        return -self.flange.tau * self.w
