"""LimIntegrator: integral of the input within limits, without wind-up."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise
from components.blocks.integrator import Integrator


class LimIntegrator(Integrator):
    """Integral of the input within limits, without wind-up."""

    out_max: Scalar = parameter("upper limit of the output", default=1)
    out_min: Scalar = parameter("lower limit of the output", default=lambda s: -s.out_max)

    def rate(self):
        """The one of the input, 0 where it leads beyond a limit."""
        rate = self.k * self.u
        stops = (self.x < self.out_min) & (rate < 0) | (self.x > self.out_max) & (rate > 0)
        return piecewise((0 * rate, stops), rate)
