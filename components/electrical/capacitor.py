"""Capacitor: linear capacitor."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.electrical.one_port import OnePort


class Capacitor(OnePort):
    """Linear capacitor."""

    C: Scalar = parameter("capacitance", unit="F", default=1e-6, minimum=0)
    v: Scalar = variable("voltage p.v - n.v", unit="V", fixed=True)

    def equations(self):
        yield from super().equations()
        yield self.i == self.C * der(self.v)

    def stored_energy(self):
        """Energy of the field."""
        return self.C * self.v**2 / 2
