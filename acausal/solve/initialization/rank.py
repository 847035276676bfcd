"""Rank, null space, least-norm solutions and pivots of matrices with rows scaled to length 1."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.initialization.sparse_rank import complement, gram, unit_rows
from acausal.solve.problem import by_columns, lengths

RANKS = POLICY.ranks


def scaled(rows: np.ndarray) -> np.ndarray:
    """Rows of length 1, of one matrix or of many; rows that vanish stay."""
    size = np.linalg.norm(rows, axis=-1, keepdims=True)
    return rows / np.where(size > 0, size, 1.0)


def rank(rows: np.ndarray, tolerance: float = RANKS.rank) -> int:
    """Number of independent rows."""
    if not rows.size:
        return 0
    return int(np.sum(scipy.linalg.svd(scaled(rows), compute_uv=False) > tolerance * _size(rows)))


def is_regular(rows: scipy.sparse.csc_matrix, tolerance: float = RANKS.rank) -> bool:
    """Return whether all rows of a sparse matrix are independent."""
    if gram(unit_rows(rows), tolerance * _size(rows)):
        return True
    return rank(rows.toarray(), tolerance) == rows.shape[0]


def _size(rows: np.ndarray | scipy.sparse.csc_matrix) -> int:
    """Number of terms over which the round-off of singular values accumulates."""
    return min(max(rows.shape), RANKS.small)


def least_norm(
    rows: np.ndarray | scipy.sparse.csc_matrix, sizes: np.ndarray, cutoff: float
) -> Callable[[np.ndarray], np.ndarray]:
    """Return a least-squares solver of least norm relative to the sizes of the unknowns, with a cutoff of singular values."""
    if isinstance(rows, np.ndarray):
        matrix = rows * sizes
    else:
        sparse = by_columns(rows, sizes)
        inverse = gram(sparse, cutoff)
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
    """Return a solver by sparse LU factors, by `least_norm` if the matrix is singular or not square."""
    try:
        return scipy.sparse.linalg.splu(J.tocsc(), permc_spec=order).solve
    except RuntimeError:
        return least_norm(J.toarray(), sizes, cutoff)
    except ValueError:  # some equations are redundant: their units would decide which singular values count as 0
        length = lengths(by_columns(J.tocsc(), sizes))
        length = np.where(length > 0, length, 1.0)
        solve = least_norm(J.toarray() / length[:, None], sizes, cutoff)
        return lambda right: solve((right.T / length).T)


def null_space(rows: np.ndarray | scipy.sparse.csc_matrix, independent: int | None = None) -> np.ndarray:
    """Orthonormal rows that span the null space.

    Parameters
    ----------
    rows : array or sparse matrix, shape (m, n)
        The rows.
    independent : int, optional
        Their rank, if known.
    """
    if not isinstance(rows, np.ndarray):
        found = complement(rows, RANKS.rank * _size(rows))
        return null_space(rows.toarray(), independent) if found is None else found
    if not rows.size:
        return np.eye(rows.shape[1])
    return scipy.linalg.svd(scaled(rows))[2][rank(rows) if independent is None else independent :]


def row_space(rows: np.ndarray) -> np.ndarray:
    """Orthonormal rows that span the row space."""
    return scipy.linalg.svd(scaled(rows), full_matrices=False)[2][: rank(rows)] if rows.size else rows


def outside(rows: scipy.sparse.csc_matrix) -> Callable[[np.ndarray], np.ndarray]:
    """Return the orthogonal projector on the null space."""
    own = unit_rows(rows)
    inverse = gram(own, RANKS.rank * _size(rows))
    if inverse:
        return lambda v: v - own.T @ inverse(own @ v)
    basis = row_space(rows.toarray())
    return lambda v: v - basis.T @ (basis @ v)


def columns_by_pivots(rows: scipy.sparse.csc_matrix) -> np.ndarray:
    """As many columns as rows, chosen by pivots so that the rows are well conditioned in them."""
    null = complement(rows, RANKS.rank * _size(rows))
    if null is None:
        return pivots(rows.toarray())[: rows.shape[0]]
    return np.setdiff1d(np.arange(rows.shape[1]), pivots(null)[: len(null)])


def pivots(matrix: np.ndarray) -> np.ndarray:
    """Columns in the order of a QR factorization with column pivoting."""
    factors: Any = scipy.linalg.qr(matrix, mode="r", pivoting=True)
    return np.asarray(factors[1], dtype=int)
