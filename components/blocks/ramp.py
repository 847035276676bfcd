"""Ramp: ramp from offset to offset + height."""

from __future__ import annotations

from acausal import Scalar, parameter, ramp
from components.blocks.so import SO


class Ramp(SO):
    """Ramp from offset to offset + height."""

    height: Scalar = parameter("height", default=1)
    duration: Scalar = parameter("duration", unit="s", default=2, positive=True)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == ramp(self.height, self.duration, self.offset, self.start_time)
