"""Pulse: rectangular pulses."""

from __future__ import annotations

from acausal import Scalar, parameter, pulse, structural
from components.blocks.so import SO


class Pulse(SO):
    """Rectangular pulses."""

    amplitude: Scalar = parameter("height of the pulses", default=1)
    width: Scalar = parameter("width in per cent of the period", default=50)
    period: Scalar = parameter("period", unit="s", default=1, positive=True)
    n_period: int = structural("number of pulses, negative without end", default=-1)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == pulse(self.amplitude, self.width, self.period, self.n_period, self.offset, self.start_time)
