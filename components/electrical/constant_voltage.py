"""ConstantVoltage: source of a constant voltage."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.electrical.one_port import OnePort


class ConstantVoltage(OnePort):
    """Source of a constant voltage."""

    V: Scalar = parameter("voltage", unit="V", default=1)

    def equations(self):
        yield from super().equations()
        yield self.v == self.V

    def supplied_power(self):
        """Power into the circuit."""
        return -self.v * self.i
