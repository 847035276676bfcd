"""Less: 1 where the first input is the smaller one."""

from __future__ import annotations

from acausal import piecewise
from components.blocks.si2so import SI2SO


class Less(SI2SO):
    """1 where the first input is the smaller one."""

    def equations(self):
        yield self.y == piecewise((1, self.u1 < self.u2), 0)
