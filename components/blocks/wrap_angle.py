"""WrapAngle: angle within one turn."""

from __future__ import annotations

import math

from acausal import floor, structural
from components.blocks.siso import SISO


class WrapAngle(SISO):
    """Angle within one turn."""

    positive_range: bool = structural(
        "whether it lies in [0, 2 pi), else in [-pi, pi)", default=False, choices=(True, False)
    )

    def equations(self):
        below = 0 if self.positive_range else 0.5
        yield self.y == self.u - 2 * math.pi * floor(self.u / (2 * math.pi) + below)
