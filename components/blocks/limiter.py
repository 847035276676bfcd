"""Limiter: input within constant limits."""

from __future__ import annotations

from acausal import Scalar, clip, parameter
from components.blocks.siso import SISO


class Limiter(SISO):
    """Input within constant limits."""

    u_max: Scalar = parameter("upper limit", default=1)
    u_min: Scalar = parameter("lower limit", default=lambda s: -s.u_max)

    def equations(self):
        yield self.y == clip(self.u, self.u_min, self.u_max)
