"""GeneralPositionToForceAdaptor: motion signals in, force signal out."""

from __future__ import annotations

from acausal import Scalar, input, output, port, structural
from components.prescribed_motion import PrescribedMotion
from components.translational.flange import TranslationalFlange


class GeneralPositionToForceAdaptor(PrescribedMotion):
    """Prescribes the motion of a flange by signals of position, speed and acceleration, and outputs its force."""

    ends = ("flange", "flange")
    use_pder: bool = structural("whether the speed is given", default=True, choices=(True, False))
    use_pder2: bool = structural("whether the acceleration is given as well", default=True, choices=(True, False))
    flange: TranslationalFlange = port(TranslationalFlange, "rod end with prescribed motion")
    p: Scalar = input("position of the flange", unit="m")
    pder: Scalar = input("speed of the flange", unit="m/s", doc="0 if unused.")
    pder2: Scalar = input("acceleration of the flange", unit="m/s2", doc="0 if unused.")
    f: Scalar = output("driving force, -flange.f", unit="N")

    def levels(self) -> int:
        """Return the number of signals: position, speed and acceleration."""
        return 1 + self.use_pder * (1 + self.use_pder2)

    def equations(self):
        yield from self.motion_equations(self.p, self.pder, self.pder2)
        yield self.flange.s == self.motion[0]
        yield self.f == -self.flange.f

    def supplied_power(self):
        """Power into the rod, if the speed is given."""
        return self.f * self.pder
