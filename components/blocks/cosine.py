"""Cosine: cosine wave."""

from __future__ import annotations

import math

from acausal import sine
from components.blocks.sine import Sine


class Cosine(Sine):
    """Cosine wave."""

    def equations(self):
        yield self.y == sine(self.amplitude, self.f, self.phase + math.pi / 2, self.offset, self.start_time)
