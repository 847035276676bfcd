"""UniformNoise: uniformly distributed random numbers, held for a sample period each."""

from __future__ import annotations

import numpy as np

from acausal import Scalar, Table, parameter, structural, table, time
from components.blocks.so import SO


class UniformNoise(SO):
    """Uniformly distributed random numbers, held for a sample period each."""

    y_min: Scalar = parameter("least value", default=0)
    y_max: Scalar = parameter("largest value", default=1)
    sample_period: Scalar = parameter("how long each number holds", unit="s", default=0.01, positive=True)
    seed: int = structural("number that chooses the sequence", default=1)
    count: int = structural("numbers until they repeat themselves", default=10_000, minimum=2)

    def equations(self):
        numbers = np.random.default_rng(self.seed).uniform(size=self.count + 1)
        data = Table(np.arange(self.count + 1), numbers, "constant", "periodic")
        yield self.y == self.y_min + (self.y_max - self.y_min) * table(time / self.sample_period, data)
