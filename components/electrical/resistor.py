"""Resistor: ohmic resistor."""

from __future__ import annotations

from acausal import Scalar, parameter, variable
from components.electrical.one_port import OnePort
from components.thermal.heat_loss import HeatLoss


class Resistor(HeatLoss, OnePort):
    """Ohmic resistor, whose resistance may depend on its temperature."""

    R: Scalar = parameter("resistance at T_ref", unit="Ohm", default=1)
    T_ref: Scalar = parameter("reference temperature", unit="K", default=300.15)
    alpha: Scalar = parameter("temperature coefficient of the resistance", unit="1/K", default=0)
    T: Scalar = parameter("temperature without a heat port", unit="K", default=lambda s: s.T_ref)
    R_actual: Scalar = variable("resistance at the present temperature", unit="Ohm")

    def equations(self):
        yield from super().equations()
        T = self.heat_port.T if self.use_heat_port else self.T
        yield self.R_actual == self.R * (1 + self.alpha * (T - self.T_ref))
        yield self.v == self.R_actual * self.i

    def loss(self):
        """Power of the current."""
        return self.v * self.i
