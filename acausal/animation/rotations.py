"""Quaternions of rotation matrices over time."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

# A matrix that is farther than this from a rotation is none; integrated ones drift by the tolerance of the run.
NO_ROTATION = 1e-2


def quaternions(T: np.ndarray) -> np.ndarray:
    """Return quaternions (w, x, y, z) that turn vectors of a frame into the world, their signs continuous in time.

    Parameters
    ----------
    T : array, shape (times, 3, 3)
        Rotation matrices from the world to the frame.

    Returns
    -------
    array, shape (times, 4)
        Of length 1; w of the first is not negative.

    Raises
    ------
    ValueError
        If a matrix is no rotation.
    """
    if np.max(np.abs(T @ T.transpose(0, 2, 1) - np.eye(3)), initial=0) > NO_ROTATION or np.any(np.linalg.det(T) < 0):
        raise ValueError("no rotation matrix")
    q = np.roll(Rotation.from_matrix(T.transpose(0, 2, 1)).as_quat(), 1, axis=1)
    if len(q) and q[0, 0] < 0:
        q[0] *= -1
    turned = np.where(np.sum(q[1:] * q[:-1], axis=1) < 0, -1.0, 1.0)
    q[1:] *= np.cumprod(turned)[:, None]
    return q


def turns(q: np.ndarray) -> np.ndarray:
    """Return the angles in rad from each of some quaternions, shape (times, 4), to the next, at most a half turn."""
    return 2 * np.arccos(np.minimum(np.abs(np.sum(q[1:] * q[:-1], axis=1)), 1))
