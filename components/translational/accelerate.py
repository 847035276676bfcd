"""Accelerate: drive with prescribed acceleration."""

from __future__ import annotations

from acausal import PREFER, Scalar, der, input, variable
from components.translational.one_flange import OneFlange


class Accelerate(OneFlange):
    """Drive that prescribes the acceleration of the rod, starting from s and v."""

    a_ref: Scalar = input("acceleration of the flange", unit="m/s2")
    s: Scalar = variable("position of the flange relative to the support", unit="m", select=PREFER)
    v: Scalar = variable("der(s)", unit="m/s", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")

    def equations(self):
        yield from super().equations()
        yield self.a == der(self.v)
        yield self.a == self.a_ref
