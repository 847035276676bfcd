"""InitializeFlange: initial conditions of a rod end."""

from __future__ import annotations

from acausal import Component, Scalar, der, input, port, structural, variable
from components.translational.flange import TranslationalFlange


class InitializeFlange(Component):
    """Sets initial position, speed and acceleration of a rod end, without force."""

    ends = ("flange", "flange")
    use_s_start: bool = structural("whether the initial position is given", default=True, choices=(True, False))
    use_v_start: bool = structural("whether the initial speed is given", default=True, choices=(True, False))
    use_a_start: bool = structural("whether the initial acceleration is given", default=True, choices=(True, False))
    s_start: Scalar = input("initial position", unit="m", default=0.0)
    v_start: Scalar = input("initial speed", unit="m/s", default=0.0)
    a_start: Scalar = input("initial acceleration", unit="m/s2", default=0.0)
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
