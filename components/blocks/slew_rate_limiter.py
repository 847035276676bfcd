"""SlewRateLimiter: input with a limited rate of change."""

from __future__ import annotations

from acausal import Scalar, clip, der, parameter, variable
from components.blocks.siso import SISO


class SlewRateLimiter(SISO):
    """Input with a limited rate of change."""

    rising: Scalar = parameter("largest rate", unit="1/s", default=1)
    falling: Scalar = parameter("smallest rate", unit="1/s", default=lambda s: -s.rising)
    Td: Scalar = parameter("time constant of the output within the limits", unit="s", default=0.001, positive=True)
    x: Scalar = variable("output, initially the input", unit="1")

    def equations(self):
        yield der(self.x) == clip((self.u - self.x) / self.Td, self.falling, self.rising)
        yield self.y == self.x

    def initial_equations(self):
        yield self.x == self.u
