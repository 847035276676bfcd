"""FirstOrder: first-order lag: k / (T s + 1)."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.blocks.siso import SISO


class FirstOrder(SISO):
    """First-order lag: k / (T s + 1)."""

    k: Scalar = parameter("gain", default=1)
    T: Scalar = parameter("time constant", unit="s", default=1, positive=True)
    y_start: Scalar = parameter("initial output", default=0)
    x: Scalar = variable("output")

    def equations(self):
        yield der(self.x) == (self.k * self.u - self.x) / self.T
        yield self.y == self.x

    def initial_equations(self):
        yield self.x == self.y_start
