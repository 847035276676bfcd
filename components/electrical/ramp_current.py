"""RampCurrent: source of a current that rises from one value to another."""

from __future__ import annotations

from acausal import Scalar, parameter, ramp
from components.electrical.source import Source


class RampCurrent(Source):
    """Source of a current that rises from one value to another."""

    I: Scalar = parameter("height", unit="A", default=1)
    duration: Scalar = parameter("duration of the rise", unit="s", default=2, positive=True)
    offset: Scalar = parameter("current added", unit="A", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.i == ramp(self.I, self.duration, self.offset, self.start_time)
