"""LimIntegrator: integral of the input within limits, without wind-up."""

from __future__ import annotations

from acausal import Scalar, der, parameter, piecewise, variable
from components.blocks.siso import SISO


class LimIntegrator(SISO):
    """Integral of the input within limits, without wind-up."""

    k: Scalar = parameter("gain", default=1)
    out_max: Scalar = parameter("upper limit of the output", default=1)
    out_min: Scalar = parameter("lower limit of the output", default=lambda s: -s.out_max)
    y_start: Scalar = parameter("initial output", default=0)
    x: Scalar = variable("integral")

    def equations(self):
        rate = self.k * self.u
        stops = (self.x < self.out_min) & (rate < 0) | (self.x > self.out_max) & (rate > 0)
        yield der(self.x) == piecewise((0 * rate, stops), rate)
        yield self.y == self.x

    def initial_equations(self):
        yield self.x == self.y_start
