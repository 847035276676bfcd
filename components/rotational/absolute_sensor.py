"""AbsoluteSensor: base of sensors at one shaft end."""

from __future__ import annotations

from typing import Any

from acausal import Component, port
from components.flange import Flange


class AbsoluteSensor(Component):
    """Base of sensors at one shaft end, which transmit no torque; a subclass defines the measured values."""

    ends = ("flange", "flange")
    flange: Flange = port(Flange, "measured shaft end")

    def equations(self):
        yield self.flange.tau == 0
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")
