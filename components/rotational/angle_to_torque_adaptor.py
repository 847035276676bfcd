"""AngleToTorqueAdaptor: motion signals in, torque signal out."""

from __future__ import annotations

from acausal import Scalar, input, output, port, structural
from components.flange import Flange
from components.prescribed_motion import PrescribedMotion


class AngleToTorqueAdaptor(PrescribedMotion):
    """Prescribes the motion of a flange by signals of angle, speed and acceleration, and outputs its torque."""

    ends = ("flange", "flange")
    motion_units = ("rad", "rad/s", "rad/s2")
    use_w: bool = structural("whether the speed is given", default=True, choices=(True, False))
    use_a: bool = structural("whether speed and acceleration are given", default=True, choices=(True, False))
    flange: Flange = port(Flange, "shaft end with prescribed motion")
    phi: Scalar = input("angle of the flange", unit="rad")
    w: Scalar = input("speed of the flange", unit="rad/s", doc="0 if unused.")
    a: Scalar = input("acceleration of the flange", unit="rad/s2", doc="0 if unused.")
    tau: Scalar = output("driving torque, -flange.tau", unit="N.m")

    def levels(self) -> int:
        """Return the number of signals: angle, speed and acceleration."""
        return 3 if self.use_a else 2 if self.use_w else 1

    def equations(self):
        yield from self.motion_equations(self.phi, self.w, self.a)
        yield self.flange.phi == self.motion[0]
        yield self.tau == -self.flange.tau

    def supplied_power(self):
        """Power into the shaft, if the speed is given."""
        return self.tau * self.w
