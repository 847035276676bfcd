"""LowpassButterworth: butterworth low-pass filter of order n."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from acausal import Scalar, der, parameter, structural, variable
from components.blocks.siso import SISO


class LowpassButterworth(SISO):
    """Butterworth low-pass filter of order n."""

    n: int = structural("order", default=2, minimum=1)
    f: Scalar = parameter("cut-off frequency, where the gain is -3 dB", unit="Hz", default=1, positive=True)
    x1_start: Any = parameter(
        "initial outputs of the sections", shape=lambda s: (s.n // 2,), default=lambda s: np.zeros(s.n // 2)
    )
    x2_start: Any = parameter("initial derivatives", shape=lambda s: (s.n // 2,), default=lambda s: np.zeros(s.n // 2))
    xr_start: Scalar = parameter("initial output of the section of order 1", default=0)
    x1: Any = variable("outputs of the sections of order 2", shape=lambda s: (max(1, s.n // 2),))
    x2: Any = variable("their derivatives over the cut-off frequency", shape=lambda s: (max(1, s.n // 2),))
    xr: Scalar = variable("output of the section of order 1, for odd n")

    def equations(self):
        w, signal = 2 * math.pi * self.f, self.u
        if self.n % 2:
            yield der(self.xr) == w * (signal - self.xr)
            signal = self.xr
        else:
            yield self.xr == 0
        if self.n == 1:
            yield self.x1[0] == 0
            yield self.x2[0] == 0
        for k in range(self.n // 2):
            damping = math.sin(math.pi * (2 * k + 1) / (2 * self.n))
            yield der(self.x1[k]) == w * self.x2[k]
            yield der(self.x2[k]) == w * (signal - self.x1[k] - 2 * damping * self.x2[k])
            signal = self.x1[k]
        yield self.y == signal

    def initial_equations(self):
        if self.n % 2:
            yield self.xr == self.xr_start
        if self.n > 1:
            yield self.x1 == self.x1_start
            yield self.x2 == self.x2_start
