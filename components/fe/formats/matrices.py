"""Sparse matrices from what files hold: triangles, equations in an order of their own, internal equations."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from components.fe.formats.text import wrong

Matrices = tuple[Any, Any, np.ndarray]


def from_entries(
    path: str | Path, rows: np.ndarray, columns: np.ndarray, values: np.ndarray, n: int, *, full: bool = True
) -> Any:
    """Return a square matrix from its entries, the other triangle included where the file holds one of them.

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
        Whether every equation has an entry on the diagonal.

    Raises
    ------
    DeclarationError
        If an entry lies outside or stands twice, or an equation that should has no entry on the diagonal: the file was
        cut.
    """
    for index in (rows, columns):
        if index.size and (index.min() < 0 or index.max() >= n):
            place = int(np.flatnonzero((index < 0) | (index >= n))[0])
            at = f"({rows[place] + 1}, {columns[place] + 1})"
            raise wrong(path, f"an entry stands at {at}, but there are {n} equations")
    matrix = sp.coo_array((values, (rows, columns)), (n, n)).tocsr()
    if matrix.nnz < values.size:
        order = np.lexsort((columns, rows))
        twice = order[1:][(np.diff(rows[order]) == 0) & (np.diff(columns[order]) == 0)][0]
        raise wrong(path, f"the entry ({rows[twice] + 1}, {columns[twice] + 1}) stands twice")
    missing = np.setdiff1d(np.arange(n), rows[rows == columns])
    if full and missing.size:
        raise wrong(path, f"equation {missing[0] + 1} of {n} has no entry on the diagonal; the file may be cut off")
    return mirrored(matrix)


def mirrored(matrix: Any) -> Any:
    """Return the symmetric matrix of which one entry of each pair is given; one with both is returned as it is."""
    shape = sp.csr_array((np.ones(matrix.nnz), matrix.indices, matrix.indptr), matrix.shape)
    if shape.multiply(shape.T).nnz > np.count_nonzero(shape.diagonal()):
        return matrix
    return (matrix + matrix.T - sp.diags_array(matrix.diagonal())).tocsr()


def placed(matrix: Any, places: Sequence[int] | np.ndarray, n: int) -> Any:
    """Return the matrix of n equations in which equation k of a given one is equation places[k]; others are empty."""
    entries = matrix.tocoo()
    places = np.asarray(places)
    return sp.coo_array((entries.data, (places[entries.row], places[entries.col])), (n, n)).tocsr()


def condensed(stiffness: Any, inner: np.ndarray) -> Any:
    """Return K_bb - K_bi inv(K_ii) K_ib: the stiffness of the other equations where no force acts on the inner ones.

    Parameters
    ----------
    stiffness : sparse (n, n)
        Symmetric.
    inner : array of bool (n,)
        Equations to be eliminated, few in each group that is coupled: those of one element.
    """
    outer = ~inner
    K_ii, K_ib = (stiffness[inner][:, part].tocsr() for part in (inner, outer))
    rest = stiffness[outer][:, outer] - K_ib.T @ _inverse(K_ii) @ K_ib
    return ((rest + rest.T) / 2).tocsr()  # symmetric to the last digit, whatever the order of the sums


def _inverse(matrix: Any) -> Any:
    """The inverse of a symmetric matrix of many small blocks, whatever the order of its equations."""
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
    """Return the largest force that a stiffness opposes to rigid motions of its nodes, as a part of its terms' sizes."""
    r = nodes - nodes.mean(axis=0)
    motions = [np.tile(e, (len(r), 1)) for e in np.eye(3)] + [np.cross(e, r) for e in np.eye(3)]
    R = np.stack([motion.ravel() for motion in motions], axis=1)
    sizes = (abs(stiffness) @ abs(R)).max(axis=0)
    return float((abs(stiffness @ R).max(axis=0) / np.where(sizes > 0, sizes, 1.0)).max())
