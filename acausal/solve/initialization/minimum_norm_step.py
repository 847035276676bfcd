"""Newton steps that change what equations determine as little as possible, and leave the rest."""

from __future__ import annotations

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.initialization.rank import scaled

REST = POLICY.rest


def least_change(value: np.ndarray, J: np.ndarray, way: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least squares step for what rows determine, and the part of a way that they leave free.

    Parameters
    ----------
    value, J : arrays, shapes (m,), (m, n)
        Residuals, and their Jacobian.
    way, scale : arrays, shape (n,)
        Changes of the unknowns, and their sizes.
    """
    # Stiff parts beside others that are held by weight alone: without equilibration these would count as free.
    size = scale
    for _ in range(2):
        inside = np.linalg.norm(scaled(J * size), axis=0)
        size = size / np.where(inside > REST.faint, inside, 1.0)
    length = np.linalg.norm(J * size, axis=1)
    if (found := _determined(value / np.where(length > 0, length, 1.0), scaled(J * size))) is not None:
        return size * found, np.zeros_like(way)
    U, s, V = np.linalg.svd(scaled(J * size), full_matrices=True)
    rank = int(np.sum(s > REST.weak))
    held, free = V[:rank], V[rank:]
    step = -held.T @ ((U.T[:rank] @ (value / np.where(length > 0, length, 1.0))) / s[:rank])
    return size * step, scale * _along(free * size / scale, way / scale)


def _determined(value: np.ndarray, J: np.ndarray) -> np.ndarray | None:
    """Return the step where rows determine all unknowns, by orthogonal factors, which take a tenth of the time of an SVD.

    The least singular value is at least 1 / (|R^-1|_1 sqrt(n)), R the triangular factor (Higham 2002, section 15.6). None where
    it may be `weak`, and for small matrices.
    """
    m, n = J.shape
    if n <= POLICY.ranks.small or m < n:
        return None
    Q, R = scipy.linalg.qr(J, mode="economic", check_finite=False)
    if not np.min(np.abs(np.diag(R))) > REST.weak:
        return None
    inverse = scipy.linalg.solve_triangular(R, np.eye(n), check_finite=False)
    if not np.linalg.norm(inverse, 1) * np.sqrt(n) * REST.weak < 1:
        return None
    return -(inverse @ (Q.T @ value))


def _along(rows: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Part of a way in the space that rows span."""
    return rows.T @ np.linalg.lstsq(rows.T, way, rcond=POLICY.ranks.rank)[0] if len(rows) else np.zeros_like(way)
