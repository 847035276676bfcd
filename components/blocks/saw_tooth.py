"""SawTooth: saw teeth."""

from __future__ import annotations

from acausal import Scalar, mod, parameter, piecewise, time
from components.blocks.so import SO


class SawTooth(SO):
    """Saw teeth."""

    amplitude: Scalar = parameter("height of the teeth", default=1)
    period: Scalar = parameter("period", unit="s", default=1, positive=True)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == self.offset + piecewise(
            (0, time < self.start_time),
            self.amplitude * (mod(time - self.start_time, self.period) / self.period),
        )
