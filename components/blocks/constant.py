"""Constant: constant output."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.blocks.so import SO


class Constant(SO):
    """Constant output."""

    k: Scalar = parameter("value", default=1)

    def equations(self):
        yield self.y == self.k
