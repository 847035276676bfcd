"""Nodes of a mesh, with their numbers in the file and the elements between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from acausal import DeclarationError

SHOWN = 12  # nodes listed in a message


class Nodes(np.ndarray):
    """Positions of nodes in m, shape (n, 3): an array that also holds node numbers and elements.

    Slices and results of computations are plain arrays; copies have neither numbers nor cells.

    Attributes
    ----------
    numbers : array of int, shape (n,), or None
        Number of each node in the file; None if nodes are known by rows only.
    cells : dict from str to array, shape (elements, nodes of one)
        Elements by meshio's names of their types, as rows of this array; empty if unknown.
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
    """Return the rows of the nodes with these numbers in their file.

    Raises
    ------
    DeclarationError
        If the array has no node numbers, or none of its nodes has a number of the list.
    """
    known = getattr(nodes, "numbers", None)
    if known is None:
        raise DeclarationError("these nodes have no numbers; use rows, counted from 0")
    rows = {int(name): row for row, name in enumerate(known)}
    missing = [name for name in numbers if name not in rows]
    if missing:
        raise DeclarationError(
            f"there is no node {missing[0]} in the file; its node numbers are {min(rows)} to {max(rows)}"
        )
    return [rows[name] for name in numbers]


def named(nodes: Any, rows: Sequence[int] | np.ndarray) -> str:
    """Return the nodes of a message: rows counted from 0, followed by their numbers in the file if known."""
    shown = ", ".join(str(row) for row in rows[:SHOWN]) + (
        f" and {len(rows) - SHOWN} more" if len(rows) > SHOWN else ""
    )
    known = getattr(nodes, "numbers", None)
    if known is None:
        return shown
    names = ", ".join(str(known[row]) for row in rows[:SHOWN])
    return f"{shown} (in the file {names}{', ...' if len(rows) > SHOWN else ''})"
