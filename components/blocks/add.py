"""Add: weighted sum of two inputs."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.blocks.si2so import SI2SO


class Add(SI2SO):
    """Weighted sum of two inputs."""

    k1: Scalar = parameter("gain of the first input", default=1)
    k2: Scalar = parameter("gain of the second input", default=1)

    def equations(self):
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2
