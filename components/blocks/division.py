"""Division: quotient of two inputs, u1 / u2."""

from __future__ import annotations

from components.blocks.si2so import SI2SO


class Division(SI2SO):
    """Quotient of two inputs, u1 / u2."""

    def equations(self):
        yield self.y == self.u1 / self.u2
