"""PrescribedTemperature: a temperature that varies."""

from __future__ import annotations

from acausal import Component, Scalar, input, port
from components.thermal.heat_port import HeatPort


class PrescribedTemperature(Component):
    """Surroundings of a given temperature."""

    ends = ("port", "port")
    T: Scalar = input("temperature", unit="K")
    port: HeatPort = port(HeatPort, "where heat is exchanged")

    def equations(self):
        yield self.port.T == self.T

    def supplied_power(self):
        """Heat that the surroundings give."""
        return -self.port.Q_flow
