"""TableVoltage: source of a voltage by a table of time."""

from __future__ import annotations

from acausal import Scalar, Table, parameter, piecewise, structural, table, time
from components.electrical.source import Source


class TableVoltage(Source):
    """Source of a voltage by a table of time."""

    data: Table = structural("points", cls=Table)
    offset: Scalar = parameter("voltage added", unit="V", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.v == self.offset + piecewise((0, time < self.start_time), table(time - self.start_time, self.data))
