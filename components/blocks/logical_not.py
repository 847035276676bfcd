"""Not: negation of a truth value (0 or 1)."""

from __future__ import annotations

from acausal import piecewise
from components.blocks.siso import SISO


class Not(SISO):
    """Negation of a truth value (0 or 1)."""

    def equations(self):
        yield self.y == piecewise((1, self.u <= 0.5), 0)
