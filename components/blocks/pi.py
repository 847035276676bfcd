"""PI: pI controller: k (1 + 1 / (T s))."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.blocks.siso import SISO


class PI(SISO):
    """PI controller: k (1 + 1 / (T s))."""

    k: Scalar = parameter("gain", default=1)
    T: Scalar = parameter("time constant", unit="s", default=1, positive=True)
    x_start: Scalar = parameter("initial state", default=0)
    x: Scalar = variable("integral of the input over T")

    def equations(self):
        yield der(self.x) == self.u / self.T
        yield self.y == self.k * (self.x + self.u)

    def initial_equations(self):
        yield self.x == self.x_start
