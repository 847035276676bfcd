"""Or: 1 where one of two truth values is true."""

from __future__ import annotations

from acausal import piecewise
from components.blocks.si2so import SI2SO


class Or(SI2SO):
    """1 where one of two truth values is true."""

    def equations(self):
        yield self.y == piecewise((1, (self.u1 > 0.5) | (self.u2 > 0.5)), 0)
