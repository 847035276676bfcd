"""Product: product of two inputs."""

from __future__ import annotations

from components.blocks.si2so import SI2SO


class Product(SI2SO):
    """Product of two inputs."""

    def equations(self):
        yield self.y == self.u1 * self.u2
