"""IdealSwitch: base of ideal switches."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, parameter, piecewise, variable
from components.electrical.one_port import OnePort
from components.thermal.heat_loss import HeatLoss


class IdealSwitch(HeatLoss, OnePort):
    """Base of ideal switches; a subclass defines open()."""

    Ron: Scalar = parameter("resistance of the closed switch", unit="Ohm", default=1e-5, minimum=0)
    Goff: Scalar = parameter("conductance of the open switch", unit="S", default=1e-5, minimum=0)

    s: Scalar = variable("current of the closed switch in A, voltage of the open one in V")

    def equations(self):
        yield from super().equations()
        yield from self.law(self.open())

    def law(self, is_open: Any) -> Any:
        """Yield the equations of voltage and current, while a condition holds those of the open switch."""
        yield self.v == piecewise((self.s, is_open), self.Ron * self.s)
        yield self.i == piecewise((self.Goff * self.s, is_open), self.s)

    def loss(self):
        """Power of the current."""
        return self.v * self.i

    def open(self) -> Any:
        """Condition under which the switch is open."""
        raise NotImplementedError("returns the condition under which the switch is open", "return ...")
