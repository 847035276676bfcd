"""PeriodicBlock: base of sampled blocks."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, discrete, floor, maximum, parameter, reinit, time, when
from components.blocks.siso import SISO


def first(begin: Any, period: Any) -> Any:
    """Return the first of the instants begin + k period in a run, k = 0, 1, ..."""
    return begin + period * maximum(0, -floor((begin - time) / period))


def at_instants(instant: Any, period: Any, *actions: Any) -> Any:
    """Return the statement of what happens at an instant, a discrete variable, and a period after it, and so on."""
    return when(time >= instant, *actions, reinit(instant, instant + period), at_start=True)


class PeriodicBlock(SISO):
    """Base of blocks that act at equidistant instants, from the values just before each."""

    sample_period: Scalar = parameter("sample period", unit="s", default=0.1, positive=True)
    start_time: Scalar = parameter("first sample", unit="s", default=0)
    next: Scalar = discrete("time of the next sample", unit="s", start=first(start_time, sample_period))

    def sampled(self, *jumps):
        """Return the statement of the jumps at each sample."""
        return at_instants(self.next, self.sample_period, *jumps)
