"""Sign: sign of the input: -1, 0 or 1."""

from __future__ import annotations

from acausal import sign
from components.blocks.siso import SISO


class Sign(SISO):
    """Sign of the input: -1, 0 or 1."""

    def equations(self):
        yield self.y == sign(self.u)
