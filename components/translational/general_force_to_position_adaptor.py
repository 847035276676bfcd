"""GeneralForceToPositionAdaptor: force signal in, motion signals out."""

from __future__ import annotations

from acausal import Component, Scalar, der, input, output, port, structural
from components.translational.flange import TranslationalFlange


class GeneralForceToPositionAdaptor(Component):
    """Applies a force signal to a flange and outputs its position, speed and acceleration."""

    ends = ("flange", "flange")
    use_pder: bool = structural("whether the speed is an output", default=True, choices=(True, False))
    use_pder2: bool = structural("whether the acceleration is an output", default=True, choices=(True, False))
    flange: TranslationalFlange = port(TranslationalFlange, "rod end under the force")
    p: Scalar = output("position of the flange", unit="m")
    pder: Scalar = output("speed of the flange, 0 without use_pder", unit="m/s")
    pder2: Scalar = output("acceleration of the flange, 0 without use_pder or use_pder2", unit="m/s2")
    f: Scalar = input("force of the flange, flange.f", unit="N")

    def equations(self):
        yield self.p == self.flange.s
        yield self.pder == (der(self.p) if self.use_pder else 0)
        yield self.pder2 == (der(self.pder) if self.use_pder and self.use_pder2 else 0)
        yield self.flange.f == self.f

    def supplied_power(self):
        """Power into the rod."""
        return -self.f * der(self.flange.s)
