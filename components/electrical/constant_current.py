"""ConstantCurrent: source of a constant current."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.electrical.source import Source


class ConstantCurrent(Source):
    """Source of a constant current."""

    I: Scalar = parameter("current", unit="A", default=1)

    def equations(self):
        yield from super().equations()
        yield self.i == self.I
