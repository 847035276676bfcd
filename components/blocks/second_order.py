"""SecondOrder: second-order lag: k / ((s / w)^2 + 2 D (s / w) + 1)."""

from __future__ import annotations

from acausal import Scalar, der, parameter, variable
from components.blocks.siso import SISO


class SecondOrder(SISO):
    """Second-order lag: k / ((s / w)^2 + 2 D (s / w) + 1)."""

    k: Scalar = parameter("gain", default=1)
    w: Scalar = parameter("angular frequency", unit="rad/s", default=1)
    D: Scalar = parameter("damping ratio", default=1)
    y_start: Scalar = parameter("initial output", default=0)
    yd_start: Scalar = parameter("initial derivative of the output", default=0)
    x: Scalar = variable("output")
    yd: Scalar = variable("derivative of the output")

    def equations(self):
        yield der(self.x) == self.yd
        yield der(self.yd) == self.w * (self.w * (self.k * self.u - self.x) - 2 * self.D * self.yd)
        yield self.y == self.x

    def initial_equations(self):
        yield self.x == self.y_start
        yield self.yd == self.yd_start
