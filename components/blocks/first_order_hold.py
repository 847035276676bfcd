"""FirstOrderHold: samples of the input, extrapolated linearly from the last two."""

from __future__ import annotations

from acausal import Scalar, discrete, piecewise, reinit, time
from components.blocks.periodic_block import PeriodicBlock


class FirstOrderHold(PeriodicBlock):
    """Samples of the input, extrapolated linearly from the last two."""

    held: Scalar = discrete("last sample", start=0)
    slope: Scalar = discrete("slope of the last two samples", start=0)
    since: Scalar = discrete("time of the last sample", unit="s", start=0)

    def equations(self):
        first = piecewise((0 * self.u, self.next <= self.start_time), (self.u - self.held) / self.sample_period)
        yield self.sampled(reinit(self.held, self.u), reinit(self.slope, first), reinit(self.since, time))
        yield self.y == self.held + self.slope * (time - self.since)
