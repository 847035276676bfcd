"""ExpSine: exponentially damped sine wave."""

from __future__ import annotations

import math

from acausal import Scalar, exp, parameter, piecewise, sin, time
from components.blocks.so import SO


class ExpSine(SO):
    """Exponentially damped sine wave."""

    amplitude: Scalar = parameter("amplitude", default=1)
    f: Scalar = parameter("frequency", unit="Hz", default=2)
    phase: Scalar = parameter("phase", unit="rad", default=0)
    damping: Scalar = parameter("damping", unit="1/s", default=1)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == self.offset + piecewise(
            (0, time < self.start_time),
            self.amplitude
            * exp(-(time - self.start_time) * self.damping)
            * sin(2 * math.pi * self.f * (time - self.start_time) + self.phase),
        )
