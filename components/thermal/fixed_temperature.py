"""FixedTemperature: constant temperature."""

from __future__ import annotations

from acausal import Component, Scalar, parameter, port
from components.thermal.heat_port import HeatPort


class FixedTemperature(Component):
    """Environment at a constant temperature."""

    ends = ("port", "port")
    T: Scalar = parameter("temperature", unit="K")
    port: HeatPort = port(HeatPort, "heat exchange")

    def equations(self):
        yield self.port.T == self.T

    def supplied_power(self):
        """Heat flow from the environment."""
        return -self.port.Q_flow
