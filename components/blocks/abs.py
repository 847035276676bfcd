"""Abs: absolute value of the input."""

from __future__ import annotations

from components.blocks.siso import SISO


class Abs(SISO):
    """Absolute value of the input."""

    def equations(self):
        yield self.y == abs(self.u)
