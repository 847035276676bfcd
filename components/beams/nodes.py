"""Nodes: coordinates of all nodes of a beam, or forces on them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from acausal import as_expr
from components.beams.pair import Pair

NODE = 6
TRANSLATIONS, ROTATIONS = (0, 1, 3), (2, 4, 5)  # u, v, w and l v', l w', l phi


class Nodes(NamedTuple):
    """Nodal coordinates U = (u, v, l v', w, l w', l phi) in m, with the length l of an element, or forces on them in N.

    Each is a vector with one entry per node.
    """

    u: Any
    v: Any
    dv: Any
    w: Any
    dw: Any
    phi: Any

    @classmethod
    def zero(cls, count: int) -> Nodes:
        """Return zeros of `count` nodes."""
        return cls(*[as_expr(np.zeros(count))] * NODE)

    @classmethod
    def of(cls, entries: list[Any]) -> Nodes:
        """Return the nodes of a list with the six entries of every node in turn."""
        u, v, dv, w, dw, phi = (as_expr(entries[k::NODE]) for k in range(NODE))
        return cls(u, v, dv, w, dw, phi)

    def plus(self, other: Nodes) -> Nodes:
        """Return the sum."""
        return Nodes(*(a + b for a, b in zip(self, other, strict=True)))

    def times(self, factor: Any) -> Nodes:
        """Return the product with a scalar."""
        return Nodes(*(factor * a for a in self))

    def dot(self, other: Nodes) -> Any:
        """Return the sum of the products of all entries."""
        return sum(a @ b for a, b in zip(self, other, strict=True))

    def entries(self) -> list[Any]:
        """Return the six entries of every node in turn."""
        columns = [list(part) for part in self]
        return [column[k] for k in range(len(self.u)) for column in columns]

    @property
    def across(self) -> Pair:
        """Deflections v and w."""
        return Pair(self.v, self.w)

    @property
    def slopes(self) -> Pair:
        """Slopes l v' and l w'."""
        return Pair(self.dv, self.dw)


def along_nodes(u: Any, across: Pair, slopes: Pair, phi: Any) -> Nodes:
    """Return nodes with deflections and slopes in both planes."""
    return Nodes(u, across.y, slopes.y, across.z, slopes.z, phi)


def first(x: Any) -> Any:
    """Entries of the first nodes of all elements."""
    return x[:-1]


def last(x: Any) -> Any:
    """Entries of the second nodes of all elements."""
    return x[1:]


def to_first(x: Any) -> Any:
    """Forces on all nodes of forces on the first nodes of the elements."""
    return np.eye(len(x), len(x) + 1).T @ x


def to_last(x: Any) -> Any:
    """Forces on all nodes of forces on the second nodes of the elements."""
    return np.eye(len(x), len(x) + 1, 1).T @ x
