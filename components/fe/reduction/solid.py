"""The free body to be reduced: mass, stiffness, node positions and rigid-body motions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from components.fe.arrays import Array


def rigid_motions(nodes: Array, about: Array, size: float) -> Array:
    """Return unit translations along x, y, z and rotations by 1/size about them, shape (N, 3, 6)."""
    arms = (nodes - about) / size
    turns = np.cross(np.eye(3)[None], arms[:, None, :])  # node, axis, direction
    moves = np.broadcast_to(np.eye(3), (len(nodes), 3, 3))
    return np.concatenate([moves, turns.transpose(0, 2, 1)], axis=2)


@dataclass(frozen=True)
class Solid:
    """A free body with matrices checked by `checked_solid`.

    Parameters
    ----------
    mass : sparse matrix, shape (N, N)
        Mass of each pair of nodes in kg; the mass matrix is its Kronecker product with the 3 x 3 unit matrix.
    stiffness : sparse matrix, shape (3 N, 3 N)
        In N/m; equations in the order x, y, z of each node.
    nodes : array, shape (N, 3)
        Positions in m.
    empty : array of bool, shape (N,)
        Nodes without stiffness and mass.
    """

    mass: Any
    stiffness: Any
    nodes: Array
    empty: Array

    @cached_property
    def node_mass(self) -> Array:
        """Row sums of the mass matrix in kg, shape (N,)."""
        return np.asarray(self.mass.sum(axis=1)).ravel()

    @cached_property
    def total(self) -> float:
        """Mass in kg."""
        return float(self.node_mass.sum())

    @cached_property
    def centre(self) -> Array:
        """Centre of mass in m."""
        return self.node_mass @ self.nodes / self.total

    @cached_property
    def size(self) -> float:
        """Largest distance of a node from the centre of mass in m, which scales rotations to translations."""
        return float(np.linalg.norm(self.nodes[~self.empty] - self.centre, axis=1).max())

    @cached_property
    def rigid(self) -> Array:
        """Rigid-body motions, shape (3 N, 6): translations, and rotations of 1/size about the centre of mass."""
        return rigid_motions(self.nodes, self.centre, self.size).reshape(-1, 6)

    def weigh(self, motions: Array) -> Array:
        """Return the mass matrix times motions of shape (3 N, k)."""
        shape = motions.shape
        return (self.mass @ motions.reshape(len(self.nodes), -1)).reshape(shape)
