"""GeneralAngleToTorqueAdaptor: motion signals in, torque signal out."""

from __future__ import annotations

from acausal import Scalar, input, output, port, structural
from components.flange import Flange
from components.prescribed_motion import PrescribedMotion


class GeneralAngleToTorqueAdaptor(PrescribedMotion):
    """Prescribes the motion of a flange by signals of angle, speed and acceleration, and outputs its torque."""

    ends = ("flange", "flange")
    motion_units = ("rad", "rad/s", "rad/s2")
    use_pder: bool = structural("whether the speed is given", default=True, choices=(True, False))
    use_pder2: bool = structural("whether the acceleration is given as well", default=True, choices=(True, False))
    flange: Flange = port(Flange, "shaft end with prescribed motion")
    p: Scalar = input("angle of the flange", unit="rad")
    pder: Scalar = input("speed of the flange", unit="rad/s", doc="0 if unused.")
    pder2: Scalar = input("acceleration of the flange", unit="rad/s2", doc="0 if unused.")
    f: Scalar = output("driving torque, -flange.tau", unit="N.m")

    def levels(self) -> int:
        """Return the number of signals: angle, speed and acceleration."""
        return 1 + self.use_pder * (1 + self.use_pder2)

    def equations(self):
        yield from self.motion_equations(self.p, self.pder, self.pder2)
        yield self.flange.phi == self.motion[0]
        yield self.f == -self.flange.tau

    def supplied_power(self):
        """Power into the shaft, if the speed is given."""
        return self.f * self.pder
