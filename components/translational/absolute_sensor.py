"""AbsoluteSensor: base of sensors at one rod end."""

from __future__ import annotations

from typing import Any

from acausal import Component, port
from components.translational.flange import TranslationalFlange


class AbsoluteSensor(Component):
    """Base of sensors at one rod end, which transmit no force; a subclass defines the measured values."""

    ends = ("flange", "flange")
    flange: TranslationalFlange = port(TranslationalFlange, "measured rod end")

    def equations(self):
        yield self.flange.f == 0
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")
