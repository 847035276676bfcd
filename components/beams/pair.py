"""Pair: components along y and z, of every element or node."""

from __future__ import annotations

from typing import Any, NamedTuple

from acausal import as_expr


class Pair(NamedTuple):
    """Components along y and z, each a scalar or a vector with an entry per element or node."""

    y: Any
    z: Any

    def plus(self, other: Pair) -> Pair:
        """Return the sum."""
        return Pair(self.y + other.y, self.z + other.z)

    def times(self, factor: Any) -> Pair:
        """Return the product with a scalar."""
        return Pair(factor * self.y, factor * self.z)

    def scaled(self, factors: Pair) -> Pair:
        """Return the products of the components."""
        return Pair(factors.y * self.y, factors.z * self.z)

    def dot(self, other: Pair) -> Any:
        """Return the scalar product."""
        return self.y * other.y + self.z * other.z

    def quarter_turn(self) -> Pair:
        """Return (z, -y)."""
        return Pair(self.z, -self.y)


class Symmetric(NamedTuple):
    """Symmetric matrix in y and z, of every element."""

    yy: Any
    yz: Any
    zz: Any

    def times(self, x: Pair) -> Pair:
        """Return the product with a pair."""
        return Pair(self.yy * x.y + self.yz * x.z, self.yz * x.y + self.zz * x.z)


def inverse(x: Any) -> Any:
    """Return 1 / x, of every entry of a vector."""
    return as_expr([1 / entry for entry in x]) if as_expr(x).shape else 1 / x
