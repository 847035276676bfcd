"""TriggeredSampler: input at the instants at which a trigger becomes true."""

from __future__ import annotations

from acausal import Scalar, discrete, input, parameter, reinit, when
from components.blocks.siso import SISO


class TriggeredSampler(SISO):
    """Input at the instants at which a trigger becomes true."""

    trigger: Scalar = input("truth value")
    y_start: Scalar = parameter("output before the first sample", default=0)
    held: Scalar = discrete("last sample", start=y_start)

    def equations(self):
        yield when(self.trigger > 0.5, reinit(self.held, self.u))
        yield self.y == self.held
