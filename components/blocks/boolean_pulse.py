"""BooleanPulse: truth value that is true in the first part of each period."""

from __future__ import annotations

from acausal import Scalar, parameter, pulse
from components.blocks.so import SO


class BooleanPulse(SO):
    """Truth value that is true in the first part of each period."""

    width: Scalar = parameter("width in per cent of the period", default=50)
    period: Scalar = parameter("period", unit="s", default=1, positive=True)
    start_time: Scalar = parameter("start of the pulses", unit="s", default=0)

    def equations(self):
        yield self.y == pulse(1, self.width, self.period, -1, 0, self.start_time)
