"""Sqrt: square root of the input."""

from __future__ import annotations

from acausal import sqrt
from components.blocks.siso import SISO


class Sqrt(SISO):
    """Square root of the input."""

    def equations(self):
        yield self.y == sqrt(self.u)
