"""The car axis of the test set for solvers of initial value problems: two point masses in the plane, two constraints.

K q'' = spring forces + weight + G' lambda in q = (xl, yl, xr, yr), with the constraints differentiated twice.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
EPS, M, L, L0, R, OMEGA = 1e-2, 10.0, 1.0, 0.5, 0.1, 10.0
K = M * EPS**2 / 2
START = (0.0, 0.5, 1.0, 0.5, -0.5, 0.0, -0.5, 0.0)


def road(t: float | Array) -> tuple[Array, Array, Array]:
    """Return the road point (x_b, y_b) under the right wheel, its velocity and its acceleration."""
    y, yd, ydd = R * np.sin(OMEGA * t), R * OMEGA * np.cos(OMEGA * t), -R * OMEGA**2 * np.sin(OMEGA * t)
    x = np.sqrt(L**2 - y**2)
    xd = -y * yd / x
    xdd = -(xd**2 + yd**2 + y * ydd) / x
    return np.array([x, y]), np.array([xd, yd]), np.array([xdd, ydd])


def simulate(times: ArrayLike) -> Array:
    """Integrate the motion.

    Parameters
    ----------
    times : array_like
        Increasing times from the start.

    Returns
    -------
    ndarray of shape (len(times), 8)
        xl, yl, xr, yr and their derivatives at each time.
    """
    times = np.asarray(times, dtype=float)

    def derivative(t: float, state: Array) -> Array:
        left, right, v_left, v_right = state.reshape(4, 2)
        b, bd, bdd = road(t)
        arm, v_arm = left - right, v_left - v_right
        G = np.array([[*b, 0.0, 0.0], [*arm, *-arm]])
        curvature = np.array([left @ bdd + 2 * v_left @ bd, v_arm @ v_arm])
        weight = np.array([0.0, -K])
        force = np.concatenate([spring(left) + weight, spring(right - b) + weight])
        matrix = np.block([[K * np.eye(4), G.T], [G, np.zeros((2, 2))]])
        return np.concatenate([v_left, v_right, np.linalg.solve(matrix, [*force, *-curvature])[:4]])

    return solve_ivp(derivative, (0.0, times[-1]), START, "DOP853", times, rtol=1e-12, atol=1e-14).y.T


def spring(line: Array) -> Array:
    """Force of a spring of stiffness 1 on the end of its line, from the other end."""
    return (L0 / np.linalg.norm(line) - 1) * line


def violation(times: ArrayLike, states: Array) -> Array:
    """Return how much the two constraints are off, shape (len(times), 2)."""
    b = road(np.asarray(times, dtype=float))[0].T
    left, right = states[:, :2], states[:, 2:4]
    return np.column_stack([(left * b).sum(axis=1), np.linalg.norm(left - right, axis=1) - L])
