"""FixedTemperature: a constant temperature."""

from __future__ import annotations

from acausal import Component, Scalar, parameter, port
from components.thermal.heat_port import HeatPort


class FixedTemperature(Component):
    """Surroundings of a constant temperature."""

    ends = ("port", "port")
    T: Scalar = parameter("temperature", unit="K")
    port: HeatPort = port(HeatPort, "where heat is exchanged")

    def equations(self):
        yield self.port.T == self.T

    def supplied_power(self):
        """Heat that the surroundings give."""
        return -self.port.Q_flow
