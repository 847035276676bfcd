"""VariableLimiter: input within variable limits."""

from __future__ import annotations

from acausal import Scalar, clip, input
from components.blocks.siso import SISO


class VariableLimiter(SISO):
    """Input within variable limits."""

    limit1: Scalar = input("upper limit")
    limit2: Scalar = input("lower limit")

    def equations(self):
        yield self.y == clip(self.u, self.limit2, self.limit1)
