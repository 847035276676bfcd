"""GeneralTorqueToAngleAdaptor: torque signal in, motion signals out."""

from __future__ import annotations

from acausal import Component, Scalar, der, input, output, port, structural
from components.flange import Flange


class GeneralTorqueToAngleAdaptor(Component):
    """Applies a torque signal to a flange and outputs its angle, speed and acceleration."""

    ends = ("flange", "flange")
    use_pder: bool = structural("whether the speed is an output", default=True, choices=(True, False))
    use_pder2: bool = structural("whether the acceleration is an output", default=True, choices=(True, False))
    flange: Flange = port(Flange, "shaft end under the torque")
    p: Scalar = output("angle of the flange", unit="rad")
    pder: Scalar = output("speed of the flange, 0 without use_pder", unit="rad/s")
    pder2: Scalar = output("acceleration of the flange, 0 without use_pder or use_pder2", unit="rad/s2")
    f: Scalar = input("torque of the flange, flange.tau", unit="N.m")

    def equations(self):
        yield self.p == self.flange.phi
        yield self.pder == (der(self.p) if self.use_pder else 0)
        yield self.pder2 == (der(self.pder) if self.use_pder and self.use_pder2 else 0)
        yield self.flange.tau == self.f

    def supplied_power(self):
        """Power into the shaft."""
        return -self.f * der(self.flange.phi)
