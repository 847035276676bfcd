"""SineCurrent: source of a sinusoidal current."""

from __future__ import annotations

from acausal import Scalar, parameter, sine
from components.electrical.source import Source


class SineCurrent(Source):
    """Source of a sinusoidal current."""

    I: Scalar = parameter("amplitude", unit="A", default=1)
    f: Scalar = parameter("frequency", unit="Hz", default=1)
    phase: Scalar = parameter("phase", unit="rad", default=0)
    offset: Scalar = parameter("current added", unit="A", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.i == sine(self.I, self.f, self.phase, self.offset, self.start_time)
