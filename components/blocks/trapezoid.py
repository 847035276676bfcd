"""Trapezoid: trapezoidal pulses."""

from __future__ import annotations

from acausal import Scalar, parameter, structural, trapezoid
from components.blocks.so import SO


class Trapezoid(SO):
    """Trapezoidal pulses."""

    amplitude: Scalar = parameter("height of the pulses", default=1)
    rising: Scalar = parameter("duration of the rise", unit="s", default=0.1, positive=True)
    width: Scalar = parameter("duration of the top", unit="s", default=0.5)
    falling: Scalar = parameter("duration of the fall", unit="s", default=0.1, positive=True)
    period: Scalar = parameter("period", unit="s", default=1, positive=True)
    n_period: int = structural("number of pulses, negative without end", default=-1)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == trapezoid(
            self.amplitude,
            self.rising,
            self.width,
            self.falling,
            self.period,
            self.n_period,
            self.offset,
            self.start_time,
        )
