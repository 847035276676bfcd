"""StepVoltage: source of a voltage that steps."""

from __future__ import annotations

from acausal import Scalar, parameter, step
from components.electrical.source import Source


class StepVoltage(Source):
    """Source of a voltage that steps."""

    V: Scalar = parameter("height", unit="V", default=1)
    offset: Scalar = parameter("voltage added", unit="V", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.v == step(self.V, self.offset, self.start_time)
