"""PeriodicBlock: base of sampled blocks."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, discrete, floor, maximum, parameter, reinit, time, when
from components.blocks.siso import SISO


def first(begin: Any, period: Any) -> Any:
    """Return the first of the instants begin + k period in a run, k = 0, 1, ..."""
    return begin + period * maximum(0, -floor((begin - time) / period))


class PeriodicBlock(SISO):
    """Base of blocks that act at equidistant instants, from the values just before each."""

    sample_period: Scalar = parameter("sample period", unit="s", default=0.1, positive=True)
    start_time: Scalar = parameter("first sample", unit="s", default=0)
    next: Scalar = discrete("time of the next sample", unit="s", start=first(start_time, sample_period))

    def sampled(self, *jumps):
        """Return the statement of the jumps at each sample."""
        return when(time >= self.next, *jumps, reinit(self.next, self.next + self.sample_period), at_start=True)
