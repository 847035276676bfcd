"""Minimum-norm Newton step of a singular system, and the motion that the system leaves free."""

from __future__ import annotations

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.initialization.rank import scaled

REST = POLICY.rest


def minimum_norm_step(
    value: np.ndarray, J: np.ndarray, way: np.ndarray, scale: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the least-squares step of least norm, and the projection of a wanted change on the null space.

    Parameters
    ----------
    value, J : arrays, shapes (m,), (m, n)
        Residuals, and their Jacobian.
    way, scale : arrays, shape (n,)
        Wanted change of the unknowns, and their scales.
    """
    # Equilibration of columns: beside stiff parts, those that only weight supports would count as free.
    size = scale
    for _ in range(2):
        inside = np.linalg.norm(scaled(J * size), axis=0)
        size = size / np.where(inside > REST.faint, inside, 1.0)
    length = np.linalg.norm(J * size, axis=1)
    if (found := _determined(value / np.where(length > 0, length, 1.0), scaled(J * size))) is not None:
        return size * found, np.zeros_like(way)
    U, s, V = np.linalg.svd(scaled(J * size), full_matrices=True)
    rank = int(np.sum(s > REST.weak))
    determined, free = V[:rank], V[rank:]
    step = -determined.T @ ((U.T[:rank] @ (value / np.where(length > 0, length, 1.0))) / s[:rank])
    return size * step, scale * _along(free * size / scale, way / scale)


def _determined(value: np.ndarray, J: np.ndarray) -> np.ndarray | None:
    """Return the step if the rows determine all unknowns, by QR in a tenth of the time of an SVD; else, or if small, None.

    The least singular value is at least 1 / (|R^-1|_1 sqrt(n)), R the triangular factor (Higham 2002, section 15.6); it must
    exceed `REST.weak`.
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
    """Projection of a change on the space that rows span."""
    return rows.T @ np.linalg.lstsq(rows.T, way, rcond=POLICY.ranks.rank)[0] if len(rows) else np.zeros_like(way)
