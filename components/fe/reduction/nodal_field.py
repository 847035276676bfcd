"""Nodes and nodal modes, for nodal results and pictures."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from components.fe.arrays import Array, frozen


@dataclass(frozen=True, eq=False)
class NodalField:
    """Nodes and nodal modes, for nodal results after a run; no equation uses them.

    Parameters
    ----------
    nodes : array, shape (N, 3)
        Positions in the undeformed body in m, relative to the origin of the reference frame and resolved in it.
    modes : array, shape (N, 3, n)
        The displacement of each node is modes @ q, resolved in the reference frame.
    cells : dict from str to array, shape (elements, nodes of one)
        Elements by meshio's names of their types, nodes counted from 0; empty if unknown.
    """

    nodes: Array
    modes: Array
    cells: dict[str, Array] = field(default_factory=dict)

    def __post_init__(self) -> None:
        count, n = np.shape(self.nodes)[0], np.shape(self.modes)[-1]
        object.__setattr__(self, "nodes", frozen(self.nodes, (count, 3), "nodes"))
        object.__setattr__(self, "modes", frozen(self.modes, (count, 3, n), "nodal modes"))

    def first(self, n: int) -> NodalField:
        """Return the field of the first n modes."""
        return replace(self, modes=self.modes[:, :, :n])
