"""BooleanStep: truth value that becomes true at start_time."""

from __future__ import annotations

from acausal import Scalar, parameter, piecewise, structural, time
from components.blocks.so import SO


class BooleanStep(SO):
    """Truth value that becomes true at start_time."""

    start_time: Scalar = parameter("instant", unit="s", default=0)
    start_value: int = structural("output before it", default=0, choices=(0, 1))

    def equations(self):
        yield self.y == piecewise((self.start_value, time < self.start_time), 1 - self.start_value)
