"""PulseCurrent: source of rectangular pulses of current."""

from __future__ import annotations

from acausal import Scalar, parameter, pulse, structural
from components.electrical.source import Source


class PulseCurrent(Source):
    """Source of rectangular pulses of current."""

    I: Scalar = parameter("height of the pulses", unit="A", default=1)
    width: Scalar = parameter("width in per cent of the period", default=50)
    period: Scalar = parameter("period", unit="s", default=1, positive=True)
    n_period: int = structural("number of pulses, negative without end", default=-1)
    offset: Scalar = parameter("current added", unit="A", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.i == pulse(self.I, self.width, self.period, self.n_period, self.offset, self.start_time)
