"""CombiTable1D: table of one argument."""

from __future__ import annotations

from acausal import Table, structural, table
from components.blocks.siso import SISO


class CombiTable1D(SISO):
    """Values of a table at the input."""

    data: Table = structural("points", cls=Table)

    def equations(self):
        yield self.y == table(self.u, self.data)
