"""ConstantCurrent: source of a constant current."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.electrical.one_port import OnePort


class ConstantCurrent(OnePort):
    """Source of a constant current."""

    I: Scalar = parameter("current", unit="A", default=1)

    def equations(self):
        yield from super().equations()
        yield self.i == self.I

    def supplied_power(self):
        """Power into the circuit."""
        return -self.v * self.i
