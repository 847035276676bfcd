"""Nodes of a mesh that know their numbers in the file, and the elements between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal import DeclarationError

SHOWN = 12  # nodes that a message names


class Nodes(np.ndarray):
    """Positions of nodes, shape (n, 3), in m: an array like any other, which also knows where it comes from.

    Whatever is computed from it, a part of it included, is a plain array; a copy knows neither numbers nor cells.

    Attributes
    ----------
    numbers : array of int, shape (n,), or None
        Number of each node in the file; None where rows are all there is.
    cells : dict from str to array, shape (elements, nodes of one)
        Elements by the names that meshio has for their kinds, as rows of this array; empty where none are known.
    """

    numbers: np.ndarray | None
    cells: dict[str, np.ndarray]

    def __new__(
        cls, places: Any, numbers: Sequence[int] | np.ndarray | None = None, cells: Mapping[str, Any] | None = None
    ) -> Nodes:
        nodes = np.array(places, dtype=float).view(cls)
        nodes.numbers = None if numbers is None else np.array(numbers, dtype=np.int64)
        nodes.cells = {kind: np.array(rows, dtype=np.int64) for kind, rows in (cells or {}).items()}
        return nodes

    def __array_finalize__(self, source: Any) -> None:
        self.numbers, self.cells = None, {}

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        return np.asarray(array)[()]

    def __getitem__(self, key: Any) -> Any:
        return np.asarray(self)[key]


def rows_of(nodes: np.ndarray, numbers: Sequence[int]) -> list[int]:
    """Return the rows of nodes that have these numbers in the file from which they were read.

    Raises
    ------
    DeclarationError
        If the array knows no numbers, or has no node of one of these.
    """
    known = getattr(nodes, "numbers", None)
    if known is None:
        raise DeclarationError("these nodes have no numbers, but only rows, counted from 0")
    rows = {int(name): row for row, name in enumerate(known)}
    missing = [name for name in numbers if name not in rows]
    if missing:
        raise DeclarationError(f"there is no node {missing[0]} in the file, whose nodes are {min(rows)} to {max(rows)}")
    return [rows[name] for name in numbers]


def named(nodes: Any, rows: Sequence[int] | np.ndarray) -> str:
    """Return nodes for a message: rows counted from 0, and the numbers in the file where these are known."""
    shown = ", ".join(str(row) for row in rows[:SHOWN]) + (
        f" and {len(rows) - SHOWN} more" if len(rows) > SHOWN else ""
    )
    known = getattr(nodes, "numbers", None)
    if known is None:
        return shown
    names = ", ".join(str(known[row]) for row in rows[:SHOWN])
    return f"{shown} (in the file {names}{', ...' if len(rows) > SHOWN else ''})"
