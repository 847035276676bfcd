"""CombiTable2D: table of two arguments."""

from __future__ import annotations

from acausal import Table, structural, table
from components.blocks.si2so import SI2SO


class CombiTable2D(SI2SO):
    """Values of a table at two inputs."""

    data: Table = structural("points of two abscissae", cls=Table)

    def equations(self):
        yield self.y == table((self.u1, self.u2), self.data)
