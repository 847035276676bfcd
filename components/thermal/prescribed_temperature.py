"""PrescribedTemperature: variable temperature."""

from __future__ import annotations

from acausal import Component, Scalar, input, port
from components.thermal.heat_port import HeatPort


class PrescribedTemperature(Component):
    """Environment at a prescribed temperature."""

    ends = ("port", "port")
    T: Scalar = input("temperature", unit="K")
    port: HeatPort = port(HeatPort, "heat exchange")

    def equations(self):
        yield self.port.T == self.T

    def supplied_power(self):
        """Heat flow from the environment."""
        return -self.port.Q_flow
