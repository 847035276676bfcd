"""Torque: drive with prescribed torque."""

from __future__ import annotations

from acausal import Scalar, input
from components.rotational.one_flange import OneFlange


class Torque(OneFlange):
    """Drive that applies a prescribed torque to the shaft."""

    tau: Scalar = input("accelerating torque on the shaft", unit="N.m")

    def equations(self):
        yield from super().equations()
        yield self.flange.tau == -self.tau
