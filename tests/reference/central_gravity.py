"""Elliptic orbit of a point in the field of a fixed centre, by Kepler's equation."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def orbit_period(position: ArrayLike, velocity: ArrayLike, mu: float) -> float:
    """Return the duration of a revolution (parameters as in `orbit`)."""
    return float(2 * np.pi * np.sqrt(_semi_major_axis(position, velocity, mu) ** 3 / mu))


def orbit(position: ArrayLike, velocity: ArrayLike, mu: float, times: ArrayLike) -> tuple[Array, Array]:
    """Return positions and velocities on an elliptic orbit.

    Kepler's equation in the difference of eccentric anomalies and Lagrange's f and g (Battin, Astrodynamics, 4.3),
    which needs no apsidal line and so holds for circles too.

    Parameters
    ----------
    position, velocity : array_like
        From the attracting centre, at time 0; three components each.
    mu : float
        Gravitational parameter: gravitational constant times central mass (times the sum of both masses, for the
        relative motion of two bodies).
    times : array_like
        Times of the result.

    Returns
    -------
    position, velocity : ndarray of shape (len(times), 3)
    """
    r0, v0 = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    a = _semi_major_axis(position, velocity, mu)
    mean_motion = float(np.sqrt(mu / a**3))
    distance0 = float(np.linalg.norm(r0))
    t = np.remainder(np.asarray(times, dtype=float), 2 * np.pi / mean_motion)
    e_cos, e_sin = 1 - distance0 / a, float(r0 @ v0 / np.sqrt(mu * a))
    change = _eccentric_change(mean_motion * t, e_cos, e_sin)
    distance = a * (1 - e_cos * np.cos(change) + e_sin * np.sin(change))
    f = 1 - a / distance0 * (1 - np.cos(change))
    g = t - (change - np.sin(change)) / mean_motion
    f_rate = -np.sqrt(mu * a) / (distance * distance0) * np.sin(change)
    g_rate = 1 - a / distance * (1 - np.cos(change))
    return np.outer(f, r0) + np.outer(g, v0), np.outer(f_rate, r0) + np.outer(g_rate, v0)


def _semi_major_axis(position: ArrayLike, velocity: ArrayLike, mu: float) -> float:
    r, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    inverse = 2 / np.linalg.norm(r) - v @ v / mu  # vis-viva
    if inverse <= 0:
        raise ValueError("the orbit is not an ellipse: the velocity is too great")
    return float(1 / inverse)


def _eccentric_change(mean: Array, e_cos: float, e_sin: float) -> Array:
    """Solve mean = E - e_cos sin E + e_sin (1 - cos E) by bisection, ended by Newton steps."""
    low, high = mean - 2.0, mean + 2.0  # eccentric and mean anomaly differ by e at most, at both ends
    for _ in range(30):
        middle = (low + high) / 2
        above = middle - e_cos * np.sin(middle) + e_sin * (1 - np.cos(middle)) > mean
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    E = (low + high) / 2
    for _ in range(3):
        residual = E - e_cos * np.sin(E) + e_sin * (1 - np.cos(E)) - mean
        E = E - residual / (1 - e_cos * np.cos(E) + e_sin * np.sin(E))
    return E
