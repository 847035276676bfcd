"""UnitDelay: the input just before each sample."""

from __future__ import annotations

from acausal import Scalar, discrete, parameter, reinit
from components.blocks.periodic_block import PeriodicBlock


class UnitDelay(PeriodicBlock):
    """Input just before each sample: that of the sample before, if it changes at samples of the same period."""

    y_start: Scalar = parameter("output before the first sample", default=0)
    held: Scalar = discrete("last sample", start=y_start)

    def equations(self):
        yield self.sampled(reinit(self.held, self.u))
        yield self.y == self.held
