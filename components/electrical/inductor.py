"""Inductor: linear inductor."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.electrical.one_port import OnePort


class Inductor(OnePort):
    """Linear inductor."""

    L: Scalar = parameter("inductance", unit="H", default=1e-3, minimum=0)
    i: Scalar = variable("current from p to n", unit="A", fixed=True)

    def equations(self):
        yield from super().equations()
        yield self.v == self.L * der(self.i)

    def stored_energy(self):
        """Energy of the field."""
        return self.L * self.i**2 / 2
