"""Conductor: ohmic conductor."""

from __future__ import annotations

from acausal import Scalar, parameter, variable
from components.electrical.one_port import OnePort
from components.thermal.heat_loss import HeatLoss


class Conductor(HeatLoss, OnePort):
    """Ohmic conductor, whose conductance may depend on its temperature."""

    G: Scalar = parameter("conductance at T_ref", unit="S", default=1)
    T_ref: Scalar = parameter("reference temperature", unit="K", default=300.15)
    alpha: Scalar = parameter("temperature coefficient of the resistance", unit="1/K", default=0)
    T: Scalar = parameter("temperature without a heat port", unit="K", default=lambda s: s.T_ref)
    G_actual: Scalar = variable("conductance at the present temperature", unit="S")

    def equations(self):
        yield from super().equations()
        T = self.heat_port.T if self.use_heat_port else self.T
        yield self.G_actual * (1 + self.alpha * (T - self.T_ref)) == self.G
        yield self.i == self.G_actual * self.v

    def loss(self):
        """Power of the current."""
        return self.v * self.i
