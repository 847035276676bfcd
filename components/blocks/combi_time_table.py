"""CombiTimeTable: table of time."""

from __future__ import annotations

from acausal import Scalar, Table, parameter, piecewise, structural, table, time
from components.blocks.so import SO


class CombiTimeTable(SO):
    """Values of a table of time."""

    data: Table = structural("points, of times less shift_time", cls=Table)
    offset: Scalar = parameter("added to the values, and the output before start_time", default=0)
    start_time: Scalar = parameter("time before which the output is offset", unit="s", default=0)
    shift_time: Scalar = parameter("time 0 of the table", unit="s", default=lambda s: s.start_time)

    def equations(self):
        value = table(time - self.shift_time, self.data)
        yield self.y == self.offset + piecewise((0, time < self.start_time), value)
