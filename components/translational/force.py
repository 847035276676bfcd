"""Force: a drive that prescribes the force."""

from __future__ import annotations

from acausal import Scalar, input
from components.translational.one_flange import OneFlange


class Force(OneFlange):
    """Drive whose force acts on the rod."""

    f: Scalar = input("accelerating force on the rod", unit="N")

    def equations(self):
        yield from super().equations()
        yield self.flange.f == -self.f
