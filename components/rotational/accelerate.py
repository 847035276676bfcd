"""Accelerate: drive with prescribed angular acceleration."""

from __future__ import annotations

from acausal import PREFER, Scalar, der, input, variable
from components.rotational.one_flange import OneFlange


class Accelerate(OneFlange):
    """Drive that prescribes the angular acceleration of the shaft, starting from phi and w."""

    a_ref: Scalar = input("acceleration of the flange", unit="rad/s2")
    phi: Scalar = variable("angle of the flange relative to the support", unit="rad", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")

    def equations(self):
        yield from super().equations()
        yield self.a == der(self.w)
        yield self.a == self.a_ref
