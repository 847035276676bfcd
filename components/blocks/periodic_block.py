"""PeriodicBlock: base of sampled blocks."""

from __future__ import annotations

from acausal import Scalar, discrete, parameter, reinit, time, when
from components.blocks.siso import SISO


class PeriodicBlock(SISO):
    """Base of blocks that act at equidistant instants, from the values just before each."""

    sample_period: Scalar = parameter("sample period", unit="s", default=0.1, positive=True)
    start_time: Scalar = parameter("first sample", unit="s", default=0)
    next: Scalar = discrete("time of the next sample", unit="s", start=start_time)

    def sampled(self, *jumps):
        """Return the statement of the jumps at each sample."""
        return when(time >= self.next, *jumps, reinit(self.next, self.next + self.sample_period), at_start=True)
