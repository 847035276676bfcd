"""Ranks, null spaces and pivots of matrices, with rows scaled to length 1."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy

from acausal.policy import POLICY

RANKS = POLICY.ranks
TINY = np.finfo(float).tiny


def scaled(rows: np.ndarray) -> np.ndarray:
    """Rows of length 1; rows that vanish stay."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return rows / np.where(size > 0, size, 1.0)


def rank(rows: np.ndarray, tolerance: float = RANKS.rank) -> int:
    """Number of independent rows."""
    if not rows.size:
        return 0
    return int(np.sum(scipy.linalg.svd(scaled(rows), compute_uv=False) > tolerance * _size(rows)))


def is_regular(rows: scipy.sparse.csc_matrix, tolerance: float = RANKS.rank) -> bool:
    """Whether all rows of a sparse matrix are independent."""
    large = rows.shape[0] > RANKS.small
    if large and definite(scipy.sparse.diags(1 / np.maximum(lengths(rows), TINY)) @ rows, tolerance * _size(rows)):
        return True
    return rank(rows.toarray(), tolerance) == rows.shape[0]


def _size(rows: np.ndarray | scipy.sparse.csc_matrix) -> int:
    """Over which rounding of singular values adds up."""
    return min(max(rows.shape), RANKS.small)


def lengths(rows: scipy.sparse.csc_matrix) -> np.ndarray:
    """Length of each row."""
    return np.sqrt(np.bincount(rows.indices, rows.data**2, minlength=rows.shape[0]))


def definite(rows: scipy.sparse.csc_matrix, tolerance: float) -> Callable[[np.ndarray], np.ndarray] | None:
    """Return a solver with A A', from sparse factors, if all singular values of the rows A exceed a tolerance.

    A A' - t^2 has as many negative eigenvalues as negative pivots (Sylvester's law of inertia). None if there may be smaller
    ones; so it is where the square of the tolerance is rounding.
    """
    least = max(tolerance, RANKS.squared)
    shift = scipy.sparse.identity(rows.shape[0]) * least**2
    options = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
    product = (rows @ rows.T).tocsc()
    try:
        shifted = scipy.sparse.linalg.splu((product - shift).tocsc(), **options)
        if not (np.array_equal(shifted.perm_r, shifted.perm_c) and np.all(shifted.U.diagonal() > 0)):
            return None
        return scipy.sparse.linalg.splu(product, **options).solve
    except (RuntimeError, ValueError):
        return None


def least_norm(
    rows: np.ndarray | scipy.sparse.csc_matrix, sizes: np.ndarray, cutoff: float
) -> Callable[[np.ndarray], np.ndarray]:
    """Return a solver by least squares, of least norm over the sizes of the unknowns; smaller singular values are 0."""
    if isinstance(rows, np.ndarray):
        matrix = rows * sizes
    else:
        sparse = (rows @ scipy.sparse.diags(sizes)).tocsc()
        inverse = definite(sparse, cutoff) if rows.shape[0] > RANKS.small else None
        if inverse:
            return lambda right: sizes * (sparse.T @ inverse(right))
        matrix = sparse.toarray()

    def solve(right: np.ndarray) -> np.ndarray:
        if not (np.all(np.isfinite(matrix)) and np.all(np.isfinite(right))):
            return np.full((matrix.shape[1], *right.shape[1:]), np.nan)
        return (sizes * np.linalg.lstsq(matrix, right, rcond=cutoff)[0].T).T

    return solve


def factored(
    J: scipy.sparse.csc_matrix, sizes: np.ndarray, cutoff: float, order: str = "COLAMD"
) -> Callable[[np.ndarray], np.ndarray]:
    """Return a solver by sparse factors; where the matrix is singular or has rows to spare, by `least_norm`."""
    try:
        return scipy.sparse.linalg.splu(J.tocsc(), permc_spec=order).solve
    except (RuntimeError, ValueError):
        return least_norm(J.toarray(), sizes, cutoff)


def null_space(rows: np.ndarray, independent: int | None = None) -> np.ndarray:
    """Orthonormal rows that span what all given rows map to 0.

    Parameters
    ----------
    rows : array, shape (m, n)
        The rows.
    independent : int, optional
        Their rank, if it is known better.
    """
    if not rows.size:
        return np.eye(rows.shape[1])
    return scipy.linalg.svd(scaled(rows))[2][rank(rows) if independent is None else independent :]


def row_space(rows: np.ndarray) -> np.ndarray:
    """Orthonormal rows that span the given ones."""
    return scipy.linalg.svd(scaled(rows), full_matrices=False)[2][: rank(rows)] if rows.size else rows


def pivots(matrix: np.ndarray) -> np.ndarray:
    """Columns in the order in which a QR factorisation with column pivoting takes them."""
    factors: Any = scipy.linalg.qr(matrix, mode="r", pivoting=True)
    return np.asarray(factors[1], dtype=int)
