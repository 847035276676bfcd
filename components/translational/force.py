"""Force: drive with prescribed force."""

from __future__ import annotations

from acausal import Scalar, input
from components.translational.one_flange import OneFlange


class Force(OneFlange):
    """Drive that applies a prescribed force to the rod."""

    f: Scalar = input("accelerating force on the rod", unit="N")

    def equations(self):
        yield from super().equations()
        yield self.flange.f == -self.f
