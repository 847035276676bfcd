"""LessThreshold: 1 where the input is below a threshold."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise
from components.blocks.siso import SISO


class LessThreshold(SISO):
    """1 where the input is below a threshold."""

    threshold: Scalar = parameter("threshold", default=0)

    def equations(self):
        yield self.y == piecewise((1, self.u < self.threshold), 0)
