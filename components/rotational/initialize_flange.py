"""InitializeFlange: initial conditions of a shaft end."""

from __future__ import annotations

from acausal import Component, Scalar, der, input, port, structural, variable
from components.flange import Flange


class InitializeFlange(Component):
    """Sets initial angle, speed and acceleration of a shaft end, without torque."""

    ends = ("flange", "flange")
    use_phi_start: bool = structural("whether the initial angle is given", default=True, choices=(True, False))
    use_w_start: bool = structural("whether the initial speed is given", default=True, choices=(True, False))
    use_a_start: bool = structural("whether the initial acceleration is given", default=True, choices=(True, False))
    phi_start: Scalar = input("initial angle", unit="rad", default=0.0)
    w_start: Scalar = input("initial speed", unit="rad/s", default=0.0)
    a_start: Scalar = input("initial acceleration", unit="rad/s2", default=0.0)
    flange: Flange = port(Flange, "shaft end")
    w_flange: Scalar = variable("speed of the flange", unit="rad/s")
    a_flange: Scalar = variable("acceleration of the flange", unit="rad/s2")

    def equations(self):
        yield self.w_flange == der(self.flange.phi)
        yield self.a_flange == der(self.w_flange)
        yield self.flange.tau == 0

    def initial_equations(self):
        if self.use_phi_start:
            yield self.flange.phi == self.phi_start
        if self.use_w_start:
            yield self.w_flange == self.w_start
        if self.use_a_start:
            yield self.a_flange == self.a_start
