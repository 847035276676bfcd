"""Sin: sine of the input in rad."""

from __future__ import annotations

from acausal import sin
from components.blocks.siso import SISO


class Sin(SISO):
    """Sine of the input in rad."""

    def equations(self):
        yield self.y == sin(self.u)
