"""CriticalDamping: filter of n equal poles without overshoot."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from acausal import Scalar, der, parameter, structural, variable
from components.blocks.siso import SISO


class CriticalDamping(SISO):
    """Filter of n equal poles without overshoot."""

    n: int = structural("order", default=2, minimum=1)
    f: Scalar = parameter("cut-off frequency", unit="Hz", default=1, positive=True)
    normalized: bool = structural(
        "whether the gain at f is -3 dB, else all poles are at f", default=True, choices=(True, False)
    )
    x_start: Any = parameter("initial outputs of the lags", shape=lambda s: (s.n,), default=lambda s: np.zeros(s.n))
    x: Any = variable("outputs of the n lags", shape=lambda s: (s.n,))

    def equations(self):
        alpha = math.sqrt(2 ** (1 / self.n) - 1) if self.normalized else 1
        w = 2 * math.pi * self.f / alpha
        for k in range(self.n):
            yield der(self.x[k]) == ((self.x[k - 1] if k else self.u) - self.x[k]) * w
        yield self.y == self.x[self.n - 1]

    def initial_equations(self):
        yield self.x == self.x_start
