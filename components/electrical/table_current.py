"""TableCurrent: source of a current by a table of time."""

from __future__ import annotations

from acausal import Scalar, Table, parameter, piecewise, structural, table, time
from components.electrical.source import Source


class TableCurrent(Source):
    """Source of a current by a table of time."""

    data: Table = structural("points", cls=Table)
    offset: Scalar = parameter("current added", unit="A", default=0)
    start_time: Scalar = parameter("start of the signal", unit="s", default=0)

    def equations(self):
        yield from super().equations()
        yield self.i == self.offset + piecewise((0, time < self.start_time), table(time - self.start_time, self.data))
