"""N four-bars side by side, all parallelograms: N + 1 uprights on ground points (i, 0) and N couplers, each of 1 m, 1 kg.

The couplers only shift, so that the mechanism is one pendulum in the angle th of the uprights from the x axis:
((N + 1) / 3 + N) th'' = -((N + 1) / 2 + N) g cos th.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


def inertia_and_moment(N: int) -> tuple[float, float]:
    """Return the factors of th'' and of -g cos th."""
    return (N + 1) / 3 + N, (N + 1) / 2 + N


def motion(times: ArrayLike, N: int = 2, gravity: float = 9.81) -> tuple[Array, Array]:
    """Return the angle and the angular velocity of the uprights, which start vertical at -1 rad/s.

    Parameters
    ----------
    times : array_like
        Increasing times from the start.
    N : int
        Number of four-bars.
    gravity : float
        Acceleration of gravity along -y.
    """
    times = np.asarray(times, dtype=float)
    inertia, moment = inertia_and_moment(N)

    def derivative(_: float, state: Array) -> Array:
        return np.array([state[1], -moment / inertia * gravity * np.cos(state[0])])

    start = [np.pi / 2, -1.0]
    th, w = solve_ivp(derivative, (0.0, times[-1]), start, "DOP853", times, rtol=3e-14, atol=1e-15).y
    return th, w


def upper_end(times: ArrayLike, N: int = 2, gravity: float = 9.81) -> tuple[Array, Array]:
    """Return the coordinates x and y of the upper end of the first upright; parameters as in `motion`."""
    th, _ = motion(times, N, gravity)
    return np.cos(th), np.sin(th)
