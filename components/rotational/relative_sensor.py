"""RelativeSensor: base of sensors between two shaft ends."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, variable
from components.flange import TwoFlanges


class RelativeSensor(TwoFlanges):
    """Base of sensors between two shaft ends, which transmit no torque; a subclass defines the measured values."""

    phi_rel: Scalar = variable("angle of flange_b relative to flange_a", unit="rad")

    def equations(self):
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0
        yield from self.measure()

    def measure(self) -> Any:
        """Yield the equations of additional measured values."""
        yield from ()
