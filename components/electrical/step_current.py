"""StepCurrent: source of a current that steps."""

from __future__ import annotations

from acausal import Scalar, parameter, step
from components.electrical.source import Source


class StepCurrent(Source):
    """Source of a current that steps."""

    I: Scalar = parameter("height", unit="A", default=1)
    offset: Scalar = parameter("current added", unit="A", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.i == step(self.I, self.offset, self.start_time)
