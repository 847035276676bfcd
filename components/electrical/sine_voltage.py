"""SineVoltage: source of a sinusoidal voltage."""

from __future__ import annotations

from acausal import Scalar, parameter, sine
from components.electrical.source import Source


class SineVoltage(Source):
    """Source of a sinusoidal voltage."""

    V: Scalar = parameter("amplitude", unit="V", default=1)
    f: Scalar = parameter("frequency", unit="Hz", default=1)
    phase: Scalar = parameter("phase", unit="rad", default=0)
    offset: Scalar = parameter("voltage added", unit="V", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.v == sine(self.V, self.f, self.phase, self.offset, self.start_time)
