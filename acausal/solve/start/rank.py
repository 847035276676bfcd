"""Ranks, null spaces and pivots of small matrices, with rows scaled to length 1."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy

from acausal.policy import POLICY


def scaled(rows: np.ndarray) -> np.ndarray:
    """Rows of length 1; rows that vanish stay."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return rows / np.where(size > 0, size, 1.0)


def rank(rows: np.ndarray, tolerance: float = POLICY.ranks.rank) -> int:
    """Number of independent rows."""
    return (
        int(np.sum(scipy.linalg.svd(scaled(rows), compute_uv=False) > tolerance * max(rows.shape))) if rows.size else 0
    )


def least_norm(rows: np.ndarray, sizes: np.ndarray, cutoff: float) -> Callable[[np.ndarray], np.ndarray]:
    """Return a solver by least squares, of least norm over the sizes of the unknowns; smaller singular values are 0."""
    matrix = rows * sizes

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
