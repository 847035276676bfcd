"""CutSensor: base of sensors inserted into a shaft."""

from __future__ import annotations

from typing import Any

from components.flange import TwoFlanges


class CutSensor(TwoFlanges):
    """Base of sensors inserted into a shaft; a subclass defines the measured values."""

    def equations(self):
        yield self.flange_a.phi == self.flange_b.phi
        yield self.flange_a.tau + self.flange_b.tau == 0
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of the measured values."""
        raise NotImplementedError("yields the equations of the measured values", "yield self.y == ...")
