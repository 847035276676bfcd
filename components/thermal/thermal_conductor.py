"""ThermalConductor: heat conduction."""

from __future__ import annotations

from acausal import Component, Scalar, parameter, port, variable
from components.thermal.heat_port import HeatPort


class ThermalConductor(Component):
    """Linear heat conduction without storage."""

    ends = ("port_a", "port_b")
    G: Scalar = parameter("thermal conductance", unit="W/K", minimum=0)
    port_a: HeatPort = port(HeatPort, "first end")
    port_b: HeatPort = port(HeatPort, "second end")
    dT: Scalar = variable("port_a.T - port_b.T", unit="K")
    Q_flow: Scalar = variable("heat flow from port_a to port_b", unit="W")

    def equations(self):
        yield self.dT == self.port_a.T - self.port_b.T
        yield self.Q_flow == self.G * self.dT
        yield self.port_a.Q_flow == self.Q_flow
        yield self.port_b.Q_flow == -self.Q_flow
