"""UnitDelay: input of the sample before."""

from __future__ import annotations

from acausal import Scalar, discrete, parameter, reinit
from components.blocks.periodic_block import PeriodicBlock


class UnitDelay(PeriodicBlock):
    """Input of the sample before."""

    y_start: Scalar = parameter("output until the second sample", default=0)
    held: Scalar = discrete("last sample", start=y_start)
    before: Scalar = discrete("the sample before", start=y_start)

    def equations(self):
        yield self.sampled(reinit(self.before, self.held), reinit(self.held, self.u))
        yield self.y == self.before
