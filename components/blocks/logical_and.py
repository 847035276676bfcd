"""And: 1 where both truth values are true."""

from __future__ import annotations

from acausal import piecewise
from components.blocks.si2so import SI2SO


class And(SI2SO):
    """1 where both truth values are true."""

    def equations(self):
        yield self.y == piecewise((1, (self.u1 > 0.5) & (self.u2 > 0.5)), 0)
