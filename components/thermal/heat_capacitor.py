"""HeatCapacitor: heat storage."""

from __future__ import annotations

from acausal import PREFER, Component, Scalar, der, parameter, port, variable
from components.thermal.heat_port import HeatPort


class HeatCapacitor(Component):
    """Lumped heat capacity of uniform temperature."""

    ends = ("port", "port")
    C: Scalar = parameter("heat capacity", unit="J/K", minimum=0)
    T: Scalar = variable("temperature", unit="K", start=293.15, select=PREFER)
    der_T: Scalar = variable("der(T)", unit="K/s")
    port: HeatPort = port(HeatPort, "heat inlet")

    def equations(self):
        yield self.T == self.port.T
        yield self.der_T == der(self.T)
        yield self.C * self.der_T == self.port.Q_flow

    def stored_energy(self):
        """Heat, relative to 0 K."""
        return self.C * self.T
