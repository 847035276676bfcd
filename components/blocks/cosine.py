"""Cosine: cosine wave."""

from __future__ import annotations

import math

from acausal import Scalar, parameter, sine
from components.blocks.so import SO


class Cosine(SO):
    """Cosine wave."""

    amplitude: Scalar = parameter("amplitude", default=1)
    f: Scalar = parameter("frequency", unit="Hz", default=1)
    phase: Scalar = parameter("phase", unit="rad", default=0)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == sine(self.amplitude, self.f, self.phase + math.pi / 2, self.offset, self.start_time)
