"""Quaternions of rotation matrices over time."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

# Largest error of the products of unit vectors in a rotation matrix; integrated ones drift by the tolerance of the run.
ORTHONORMAL = 1e-2


def quaternions(T: np.ndarray) -> np.ndarray:
    """Return quaternions (w, x, y, z) of the rotation from a frame to the world, continuous in sign.

    Parameters
    ----------
    T : array, shape (times, 3, 3)
        Rotation matrices from the world to the frame.

    Returns
    -------
    array, shape (times, 4)
        Unit quaternions; w of the first is not negative.

    Raises
    ------
    ValueError
        If a matrix is not a rotation matrix.
    """
    if np.max(np.abs(T @ T.transpose(0, 2, 1) - np.eye(3)), initial=0) > ORTHONORMAL or np.any(np.linalg.det(T) < 0):
        raise ValueError("not a rotation matrix")
    q = np.roll(Rotation.from_matrix(T.transpose(0, 2, 1)).as_quat(), 1, axis=1)
    if len(q) and q[0, 0] < 0:
        q[0] *= -1
    signs = np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0)
    q[1:] *= np.cumprod(signs)[:, None]
    return q


def rotation_angles(q: np.ndarray) -> np.ndarray:
    """Return the angles in rad between successive quaternions, shape (times, 4); each at most pi."""
    return 2 * np.arccos(np.minimum(np.abs(np.sum(q[1:] * q[:-1], axis=1)), 1))
