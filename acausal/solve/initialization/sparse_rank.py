"""Rank, null space and smallest singular value of large sparse matrices with independent rows, by sparse factors."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.problem import lengths

RANKS = POLICY.ranks
SYMMETRIC = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}


def unit_rows(rows: scipy.sparse.csc_matrix) -> scipy.sparse.csc_matrix:
    """Rows of large matrices scaled to length 1; rows that vanish stay."""
    if rows.shape[0] <= RANKS.small:
        return rows
    return (scipy.sparse.diags(1 / np.maximum(lengths(rows), np.finfo(float).tiny)) @ rows).tocsc()


def gram(rows: scipy.sparse.csc_matrix, tolerance: float) -> Callable[[np.ndarray], np.ndarray] | None:
    """Return a solver with A A' for many rows A, if all their singular values exceed a tolerance; else None.

    A A' - t^2 has as many negative eigenvalues as negative pivots (Sylvester's law of inertia). The least t is that whose
    square exceeds round-off.
    """
    if rows.shape[0] <= RANKS.small:
        return None
    least = max(tolerance, RANKS.squared)
    product = (rows @ rows.T).tocsc()
    shift = scipy.sparse.identity(len(product.indptr) - 1, format="csc") * least**2
    try:
        shifted = scipy.sparse.linalg.splu(product - shift, **SYMMETRIC)
        if not (np.array_equal(shifted.perm_r, shifted.perm_c) and np.all(shifted.U.diagonal() > 0)):
            return None
        return scipy.sparse.linalg.splu(product, **SYMMETRIC).solve
    except (RuntimeError, ValueError):
        return None


def complement(rows: scipy.sparse.csc_matrix, tolerance: float) -> np.ndarray | None:
    """Orthonormal rows that span the null space of many independent rows, if it is small; else None."""
    m, n = rows.shape
    own = unit_rows(rows)
    inverse = gram(own, tolerance) if 0 < n - m <= RANKS.small else None
    if inverse is None:
        return None
    null = np.random.default_rng(0).standard_normal((n, n - m))
    for _ in range(2):  # the second time against round-off
        null = np.linalg.qr(null - own.T @ inverse(own @ null))[0]
    return null.T


def least_singular_value(rows: scipy.sparse.csc_matrix) -> float:
    """Return the smallest singular value of many sparse rows, or columns if these are fewer; 0 at round-off level."""
    own = rows if rows.shape[0] <= rows.shape[1] else rows.T
    product = (own @ own.T).tocsc()
    n = product.shape[0]
    options = {"return_eigenvectors": False, "v0": np.cos(np.arange(n)), "tol": POLICY.loops.angles}
    try:
        inverse = scipy.sparse.linalg.splu(product, **SYMMETRIC).solve
        operator = scipy.sparse.linalg.LinearOperator((n, n), matvec=inverse, dtype=float)
        largest = float(scipy.sparse.linalg.eigsh(operator, 1, **options)[0])
    except RuntimeError:
        return 0.0
    return largest**-0.5 if largest > 0 else 0.0
