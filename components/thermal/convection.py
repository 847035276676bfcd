"""Convection: heat transfer from a solid to a fluid."""

from __future__ import annotations

from acausal import Component, Scalar, input, port, variable
from components.thermal.heat_port import HeatPort


class Convection(Component):
    """Linear convective heat transfer."""

    ends = ("solid", "fluid")
    Gc: Scalar = input("convective thermal conductance", unit="W/K")
    solid: HeatPort = port(HeatPort, "surface of the solid")
    fluid: HeatPort = port(HeatPort, "fluid")
    dT: Scalar = variable("solid.T - fluid.T", unit="K")
    Q_flow: Scalar = variable("heat flow from the solid to the fluid", unit="W")

    def equations(self):
        yield self.dT == self.solid.T - self.fluid.T
        yield self.Q_flow == self.Gc * self.dT
        yield self.solid.Q_flow == self.Q_flow
        yield self.fluid.Q_flow == -self.Q_flow
