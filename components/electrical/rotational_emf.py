"""RotationalEMF: ideal rotational converter."""

from __future__ import annotations

from acausal import Scalar, der, parameter, port, structural, variable
from components.electrical.one_port import OnePort
from components.flange import Flange


class RotationalEMF(OnePort):
    """Ideal conversion of electrical into mechanical power: v = k w, torque k i."""

    k: Scalar = parameter("transformation coefficient", unit="N.m/A", default=1)
    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    flange: Flange = port(Flange, "shaft end")
    phi: Scalar = variable("angle of the flange relative to the support", unit="rad")
    w: Scalar = variable("der(phi)", unit="rad/s")

    @port
    def support(self) -> Flange | None:
        """Housing."""
        return Flange() if self.use_support else None

    def equations(self):
        yield from super().equations()
        yield self.phi == self.flange.phi - (self.support.phi if self.use_support else 0)
        yield self.w == der(self.phi)
        yield self.v == self.k * self.w
        yield self.flange.tau == -self.k * self.i
        if self.use_support:
            yield self.support.tau == -self.flange.tau
