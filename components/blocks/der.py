"""Der: derivative of the input, by differentiation of the equations."""

from __future__ import annotations

from acausal import der
from components.blocks.siso import SISO


class Der(SISO):
    """Derivative of the input, by differentiation of the equations."""

    def equations(self):
        yield self.y == der(self.u)
