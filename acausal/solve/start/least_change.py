"""Newton steps that change what equations determine as little as possible, and leave the rest."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.start.rank import scaled

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
    U, s, V = np.linalg.svd(scaled(J * size), full_matrices=True)
    rank = int(np.sum(s > REST.weak))
    held, free = V[:rank], V[rank:]
    step = -held.T @ ((U.T[:rank] @ (value / np.where(length > 0, length, 1.0))) / s[:rank])
    return size * step, scale * _along(free * size / scale, way / scale)


def _along(rows: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Part of a way in the space that rows span."""
    return rows.T @ np.linalg.lstsq(rows.T, way, rcond=POLICY.ranks.rank)[0] if len(rows) else np.zeros_like(way)
