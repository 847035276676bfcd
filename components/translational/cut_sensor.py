"""CutSensor: base of sensors inserted into a rod."""

from __future__ import annotations

from typing import Any

from components.translational.flange import TwoFlanges


class CutSensor(TwoFlanges):
    """Base of sensors inserted into a rod; a subclass defines the measured values."""

    def equations(self):
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")
