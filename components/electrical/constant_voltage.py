"""ConstantVoltage: source of a constant voltage."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.electrical.source import Source


class ConstantVoltage(Source):
    """Source of a constant voltage."""

    V: Scalar = parameter("voltage", unit="V", default=1)

    def equations(self):
        yield from super().equations()
        yield self.v == self.V
