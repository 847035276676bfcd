"""Timer: time since the input became true (above 0.5), 0 while it is false."""

from __future__ import annotations

from acausal import Scalar, discrete, piecewise, reinit, time, when
from components.blocks.siso import SISO


class Timer(SISO):
    """Time since the input became true (above 0.5), 0 while it is false."""

    entry: Scalar = discrete("time at which it became true", unit="s", start=0)

    def equations(self):
        yield when(self.u > 0.5, reinit(self.entry, time), at_start=True)
        yield self.y == piecewise((time - self.entry, self.u > 0.5), 0 * self.entry)
