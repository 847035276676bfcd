"""RampVoltage: source of a voltage that rises from one value to another."""

from __future__ import annotations

from acausal import Scalar, parameter, ramp
from components.electrical.source import Source


class RampVoltage(Source):
    """Source of a voltage that rises from one value to another."""

    V: Scalar = parameter("height", unit="V", default=1)
    duration: Scalar = parameter("duration of the rise", unit="s", default=2, positive=True)
    offset: Scalar = parameter("voltage added", unit="V", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.v == ramp(self.V, self.duration, self.offset, self.start_time)
