"""InitializeFlange: gives the start of a rod end."""

from __future__ import annotations

from acausal import Component, Scalar, der, input, port, structural, variable
from components.translational.flange import TranslationalFlange


class InitializeFlange(Component):
    """Gives position, speed and acceleration of a rod end at the start; it bears no force."""

    ends = ("flange", "flange")
    use_s_start: bool = structural("whether the position is given", default=True, choices=(True, False))
    use_v_start: bool = structural("whether the speed is given", default=True, choices=(True, False))
    use_a_start: bool = structural("whether the acceleration is given", default=True, choices=(True, False))
    s_start: Scalar = input("position at the start", unit="m", default=0.0)
    v_start: Scalar = input("speed at the start", unit="m/s", default=0.0)
    a_start: Scalar = input("acceleration at the start", unit="m/s2", default=0.0)
    flange: TranslationalFlange = port(TranslationalFlange, "rod end")
    v_flange: Scalar = variable("speed of the flange", unit="m/s")
    a_flange: Scalar = variable("acceleration of the flange", unit="m/s2")

    def equations(self):
        yield self.v_flange == der(self.flange.s)
        yield self.a_flange == der(self.v_flange)
        yield self.flange.f == 0

    def initial_equations(self):
        if self.use_s_start:
            yield self.flange.s == self.s_start
        if self.use_v_start:
            yield self.v_flange == self.v_start
        if self.use_a_start:
            yield self.a_flange == self.a_start
