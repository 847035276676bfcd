"""Assembly of sparse matrices from file entries: triangles, permuted equations, internal equations."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from components.fe.formats.text import file_error

Matrices = tuple[Any, Any, np.ndarray]


def from_entries(
    path: str | Path, rows: np.ndarray, columns: np.ndarray, values: np.ndarray, n: int, *, full: bool = True
) -> Any:
    """Return a square matrix from its entries; a single triangle is completed by symmetry.

    Parameters
    ----------
    path : str or Path
        Name of the file, for messages.
    rows, columns : array of int
        Counted from 0.
    values : array
        The entries.
    n : int
        Number of equations.
    full : bool
        Whether the diagonal is complete; a missing entry means that the file was truncated.

    Raises
    ------
    DeclarationError
        If an entry is outside the matrix or occurs twice, or a diagonal entry is missing although `full`.
    """
    for index in (rows, columns):
        if index.size and (index.min() < 0 or index.max() >= n):
            place = int(np.flatnonzero((index < 0) | (index >= n))[0])
            at = f"({rows[place] + 1}, {columns[place] + 1})"
            raise file_error(path, f"the entry {at} is outside the matrix of {n} equations")
    matrix = sp.coo_array((values, (rows, columns)), (n, n)).tocsr()
    if matrix.nnz < values.size:
        order = np.lexsort((columns, rows))
        twice = order[1:][(np.diff(rows[order]) == 0) & (np.diff(columns[order]) == 0)][0]
        raise file_error(path, f"the entry ({rows[twice] + 1}, {columns[twice] + 1}) occurs twice")
    missing = np.setdiff1d(np.arange(n), rows[rows == columns])
    if full and missing.size:
        raise file_error(path, f"equation {missing[0] + 1} of {n} has no diagonal entry; the file may be truncated")
    return mirrored(matrix)


def mirrored(matrix: Any) -> Any:
    """Return the symmetric matrix of a triangle; a matrix with entries in both triangles is returned unchanged."""
    shape = sp.csr_array((np.ones(matrix.nnz), matrix.indices, matrix.indptr), matrix.shape)
    if shape.multiply(shape.T).nnz > np.count_nonzero(shape.diagonal()):
        return matrix
    return (matrix + matrix.T - sp.diags_array(matrix.diagonal())).tocsr()


def placed(matrix: Any, places: Sequence[int] | np.ndarray, n: int) -> Any:
    """Return the matrix of n equations with equation k of the argument at places[k]; all others are empty."""
    entries = matrix.tocoo()
    places = np.asarray(places)
    return sp.coo_array((entries.data, (places[entries.row], places[entries.col])), (n, n)).tocsr()


def condensed(stiffness: Any, inner: np.ndarray) -> Any:
    """Return the static condensation K_bb - K_bi inv(K_ii) K_ib.

    Parameters
    ----------
    stiffness : sparse (n, n)
        Symmetric.
    inner : array of bool (n,)
        Equations i to eliminate. Each coupled group must be small, such as those of one element.
    """
    outer = ~inner
    K_ii, K_ib = (stiffness[inner][:, part].tocsr() for part in (inner, outer))
    rest = stiffness[outer][:, outer] - K_ib.T @ _inverse(K_ii) @ K_ib
    return ((rest + rest.T) / 2).tocsr()  # exactly symmetric despite round-off


def _inverse(matrix: Any) -> Any:
    """Return the inverse of a symmetric matrix that a permutation makes block diagonal with small blocks."""
    count, group = sp.csgraph.connected_components(matrix, directed=False)
    sizes = np.bincount(group, minlength=count)
    order = np.argsort(group, kind="stable")
    first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    found = []
    for size in np.unique(sizes):
        members = order[first[sizes == size][:, None] + np.arange(size)]
        blocks = np.stack([matrix[m][:, m].toarray() for m in members])
        rows, columns = np.broadcast_arrays(members[:, :, None], members[:, None, :])
        found.append((np.linalg.inv(blocks).ravel(), rows.ravel(), columns.ravel()))
    data, rows, columns = (np.concatenate(part) for part in zip(*found, strict=True))
    return sp.csr_array((data, (rows, columns)), matrix.shape)


def rigid_forces(stiffness: Any, nodes: np.ndarray) -> float:
    """Return the largest force of rigid-body motions, relative to the sum of its absolute terms."""
    r = nodes - nodes.mean(axis=0)
    motions = [np.tile(e, (len(r), 1)) for e in np.eye(3)] + [np.cross(e, r) for e in np.eye(3)]
    R = np.stack([motion.ravel() for motion in motions], axis=1)
    sizes = (abs(stiffness) @ abs(R)).max(axis=0)
    return float((abs(stiffness @ R).max(axis=0) / np.where(sizes > 0, sizes, 1.0)).max())
