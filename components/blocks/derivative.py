"""Derivative: approximate derivative: k s / (T s + 1)."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.blocks.siso import SISO


class Derivative(SISO):
    """Approximate derivative: k s / (T s + 1)."""

    k: Scalar = parameter("gain", default=1)
    T: Scalar = parameter("time constant", unit="s", default=0.01, positive=True)
    x_start: Scalar = parameter("initial state", default=0)
    x: Scalar = variable("input through a first-order lag")

    def equations(self):
        yield der(self.x) == (self.u - self.x) / self.T
        yield self.y == self.k / self.T * (self.u - self.x)

    def initial_equations(self):
        yield self.x == self.x_start
