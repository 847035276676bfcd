"""Cos: cosine of the input in rad."""

from __future__ import annotations

from acausal import cos
from components.blocks.siso import SISO


class Cos(SISO):
    """Cosine of the input in rad."""

    def equations(self):
        yield self.y == cos(self.u)
