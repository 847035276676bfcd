"""Exact static rod in space (Kirchhoff-Reissner), clamped at its root, with a dead force at its tip."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_bvp

Array = np.ndarray


def _matrix(q: Array) -> Array:
    """Rotation matrices from the section to the world, of quaternions (scalar part first), shape (3, 3, points)."""
    w, x, y, z = q
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def loaded_rod(
    length: float, force: Array, stiffness: tuple[float, float, float], EA: float, curvature: float = 0.0
) -> tuple[Array, Array]:
    """Return position and rotation matrix (section to world) of the tip.

    Parameters
    ----------
    length : float
        Length along the axis, which starts at the origin along x and curves towards y.
    force : array, shape (3,)
        Dead force at the tip.
    stiffness : tuple of float
        G J_t, E J_y and E J_z.
    EA : float
        Axial stiffness.
    curvature : float
        Curvature of the undeformed rod about z.
    """
    soft, natural = 1 / np.array(stiffness), np.array([0.0, 0.0, curvature])
    s = np.linspace(0, length, 60)
    Y = np.zeros((10, s.size))
    Y[0] = s if curvature == 0 else np.sin(s * curvature) / curvature
    Y[1] = 0 if curvature == 0 else (1 - np.cos(s * curvature)) / curvature
    Y[3], Y[6] = np.cos(s * curvature / 2), np.sin(s * curvature / 2)

    def slopes(load: Array, Y: Array) -> Array:
        T = _matrix(Y[3:7] / np.linalg.norm(Y[3:7], axis=0))
        k = natural[:, None] + soft[:, None] * np.einsum("jik,jk->ik", T, Y[7:10])
        tension = np.einsum("jk,j->k", T[:, 0], load)
        along = T[:, 0] * (1 + tension / EA)
        w, v = Y[3], Y[4:7]
        turn = np.vstack([-0.5 * np.sum(v * k, axis=0), 0.5 * (w * k + np.cross(v, k, axis=0))])
        return np.vstack([along, turn, -np.cross(along, load[:, None], axis=0)])

    for share in np.linspace(0.1, 1, 10):
        load = share * np.asarray(force)
        found = solve_bvp(
            lambda _, Y, load=load: slopes(load, Y),
            lambda a, b: np.r_[a[:3], a[3] - 1, a[4:7], b[7:10]],
            s,
            Y,
            tol=1e-9,
            max_nodes=20000,
        )
        assert found.status == 0
        s, Y = found.x, found.y
    q = Y[3:7, -1]
    return Y[:3, -1], _matrix((q / np.linalg.norm(q))[:, None])[:, :, 0]
