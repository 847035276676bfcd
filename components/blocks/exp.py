"""Exp: exponential of the input."""

from __future__ import annotations

from acausal import exp
from components.blocks.siso import SISO


class Exp(SISO):
    """Exponential of the input."""

    def equations(self):
        yield self.y == exp(self.u)
