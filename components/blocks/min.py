"""Min: smaller one of two inputs."""

from __future__ import annotations

from acausal import minimum
from components.blocks.si2so import SI2SO


class Min(SI2SO):
    """Smaller one of two inputs."""

    def equations(self):
        yield self.y == minimum(self.u1, self.u2)
