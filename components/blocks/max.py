"""Max: larger one of two inputs."""

from __future__ import annotations

from acausal import maximum
from components.blocks.si2so import SI2SO


class Max(SI2SO):
    """Larger one of two inputs."""

    def equations(self):
        yield self.y == maximum(self.u1, self.u2)
