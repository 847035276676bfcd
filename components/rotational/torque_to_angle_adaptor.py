"""TorqueToAngleAdaptor: torque signal in, motion signals out."""

from __future__ import annotations

from acausal import Component, Scalar, der, input, output, port, structural
from components.flange import Flange


class TorqueToAngleAdaptor(Component):
    """Applies a torque signal to a flange and outputs its angle, speed and acceleration."""

    ends = ("flange", "flange")
    use_w: bool = structural("whether the speed is an output", default=True, choices=(True, False))
    use_a: bool = structural("whether the acceleration is an output", default=True, choices=(True, False))
    flange: Flange = port(Flange, "shaft end under the torque")
    phi: Scalar = output("angle of the flange", unit="rad")
    w: Scalar = output("speed of the flange, 0 without use_w", unit="rad/s")
    a: Scalar = output("acceleration of the flange, 0 without use_a or use_w", unit="rad/s2")
    tau: Scalar = input("torque of the flange, flange.tau", unit="N.m")

    def equations(self):
        yield self.phi == self.flange.phi
        yield self.w == (der(self.phi) if self.use_w else 0)
        yield self.a == (der(self.w) if self.use_a and self.use_w else 0)
        yield self.flange.tau == self.tau

    def supplied_power(self):
        """Power into the shaft."""
        return -self.tau * der(self.flange.phi)
