"""Gain: product of a gain and the input."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.blocks.siso import SISO


class Gain(SISO):
    """Product of a gain and the input."""

    k: Scalar = parameter("gain", default=1)

    def equations(self):
        yield self.y == self.k * self.u
