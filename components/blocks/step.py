"""Step: step from offset to offset + height."""

from __future__ import annotations

from acausal import Scalar, parameter, step
from components.blocks.so import SO


class Step(SO):
    """Step from offset to offset + height."""

    height: Scalar = parameter("height", default=1)
    offset: Scalar = parameter("added to the output", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield self.y == step(self.height, self.offset, self.start_time)
