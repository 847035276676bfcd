"""NormalNoise: normally distributed random numbers, held for a sample period each."""

from __future__ import annotations

import numpy as np

from acausal import Scalar, Table, parameter, structural, table, time
from components.blocks.so import SO


class NormalNoise(SO):
    """Normally distributed random numbers, held for a sample period each."""

    mu: Scalar = parameter("mean", default=0)
    sigma: Scalar = parameter("standard deviation", default=1)
    sample_period: Scalar = parameter("how long each number holds", unit="s", default=0.01, positive=True)
    seed: int = structural("number that chooses the sequence", default=1)
    count: int = structural("numbers until they repeat themselves", default=10_000, minimum=2)

    def equations(self):
        numbers = np.random.default_rng(self.seed).normal(size=self.count + 1)
        data = Table(np.arange(self.count + 1), numbers, "constant", "periodic")
        yield self.y == self.mu + self.sigma * table(time / self.sample_period, data)
