"""Greater: 1 where the first input is the larger one."""

from __future__ import annotations

from acausal import piecewise
from components.blocks.si2so import SI2SO


class Greater(SI2SO):
    """1 where the first input is the larger one."""

    def equations(self):
        yield self.y == piecewise((1, self.u1 > self.u2), 0)
