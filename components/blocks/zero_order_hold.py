"""ZeroOrderHold: samples of the input, held until the next one."""

from __future__ import annotations

from acausal import Scalar, discrete, reinit
from components.blocks.periodic_block import PeriodicBlock


class ZeroOrderHold(PeriodicBlock):
    """Samples of the input, held until the next one."""

    held: Scalar = discrete("last sample", start=0)

    def equations(self):
        yield self.sampled(reinit(self.held, self.u))
        yield self.y == self.held
