"""RelativeSensor: base of sensors between two rod ends."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, variable
from components.translational.flange import TwoFlanges


class RelativeSensor(TwoFlanges):
    """Base of sensors between two rod ends, which transmit no force; a subclass defines the measured values."""

    s_rel: Scalar = variable("position of flange_b relative to flange_a", unit="m")

    def equations(self):
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of additional measured values."""
        yield from ()
