"""EddyCurrentForce: eddy current brake."""

from __future__ import annotations

from acausal import Scalar, input, parameter
from components.thermal.heat_loss import HeatLoss
from components.thermal.resistance import resistance_ratio
from components.translational.loading_force import LoadingForce


class EddyCurrentForce(HeatLoss, LoadingForce):
    """Eddy current brake with its maximum force at v_nominal.

    Notes
    -----
    f = 2 f_nominal excitation^2 x / (1 + x^2) with x = v / (v_nominal R / R_ref): the speed of maximum force is proportional
    to the resistance R of the material, which depends on the temperature.
    """

    f_nominal: Scalar = parameter("maximum braking force", unit="N")
    v_nominal: Scalar = parameter("speed of maximum force at T_ref", unit="m/s", positive=True)
    T_ref: Scalar = parameter("reference temperature", unit="K", default=293.15, positive=True)
    alpha20: Scalar = parameter("temperature coefficient of the material at 20 degrees Celsius", unit="1/K", default=0)
    T: Scalar = parameter("temperature of the material", unit="K", default=293.15, doc="Without heat port.")
    excitation: Scalar = input("relative excitation", unit="1", default=1.0, doc="1 for f_nominal.")

    def law(self):
        """Braking force over the speed."""
        T = self.heat_port.T if self.use_heat_port else self.T
        x = self.v / (self.v_nominal * resistance_ratio(T, self.T_ref, self.alpha20))
        yield self.f == 2 * self.f_nominal * self.excitation**2 * x / (1 + x**2)

    def loss(self):
        """Power of the force."""
        return self.f * self.v

    def supplied_power(self):
        """None: the part only brakes."""
        return 0.0
