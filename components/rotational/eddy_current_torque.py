"""EddyCurrentTorque: eddy current brake."""

from __future__ import annotations

from acausal import Scalar, input, parameter, variable
from components.rotational.one_flange import OneFlange
from components.thermal.heat_loss import HeatLoss
from components.thermal.resistance import resistance_ratio


class EddyCurrentTorque(HeatLoss, OneFlange):
    """Eddy current brake with its maximum torque at w_nominal.

    Notes
    -----
    tau = 2 tau_nominal excitation^2 x / (1 + x^2) with x = w / (w_nominal R / R_ref): the speed of maximum torque is
    proportional to the resistance R of the material, which depends on the temperature.
    """

    tau_nominal: Scalar = parameter("maximum braking torque", unit="N.m")
    w_nominal: Scalar = parameter("speed of maximum torque at T_ref", unit="rad/s", positive=True)
    T_ref: Scalar = parameter("reference temperature", unit="K", default=293.15, positive=True)
    alpha20: Scalar = parameter("temperature coefficient of the material at 20 degrees Celsius", unit="1/K", default=0)
    T: Scalar = parameter("temperature of the material", unit="K", default=293.15, doc="Without heat port.")
    excitation: Scalar = input("relative excitation", unit="1", default=1.0, doc="1 for tau_nominal.")

    tau: Scalar = variable("cut torque, flange.tau", unit="N.m")

    def equations(self):
        yield from super().equations()
        T = self.heat_port.T if self.use_heat_port else self.T
        x = self.w / (self.w_nominal * resistance_ratio(T, self.T_ref, self.alpha20))
        yield self.tau == self.flange.tau
        yield self.tau == 2 * self.tau_nominal * self.excitation**2 * x / (1 + x**2)

    def loss(self):
        """Power of the torque."""
        return self.tau * self.w

    def supplied_power(self):
        """None: the part only brakes."""
        return 0.0
