"""Transformer: two coupled inductors."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.electrical.two_port import TwoPort


class Transformer(TwoPort):
    """Two coupled inductors."""

    L1: Scalar = parameter("inductance of the first winding", unit="H", default=1)
    L2: Scalar = parameter("inductance of the second winding", unit="H", default=1)
    M: Scalar = parameter("mutual inductance", unit="H", default=0.5)
    i1: Scalar = variable("current from p1 to n1", unit="A", fixed=True)
    i2: Scalar = variable("current from p2 to n2", unit="A", fixed=True)

    def equations(self):
        yield from super().equations()
        yield self.v1 == self.L1 * der(self.i1) + self.M * der(self.i2)
        yield self.v2 == self.M * der(self.i1) + self.L2 * der(self.i2)

    def stored_energy(self):
        """Energy of the field."""
        return self.L1 * self.i1**2 / 2 + self.M * self.i1 * self.i2 + self.L2 * self.i2**2 / 2
