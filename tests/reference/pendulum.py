"""Exact motion of the simple and of the physical pendulum, released at rest.

Gravity acts along -y; the pivot is the origin; the angle is anticlockwise from the lowest position. From energy,
sin(angle/2) = k cd(w0 t, k) with k = sin(amplitude/2) and w0**2 = g/L (Whittaker, Analytical Dynamics, art. 44).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipj, ellipk

Array = NDArray[np.float64]


def period(length: float = 1.0, gravity: float = 9.81, amplitude: float = np.pi / 2) -> float:
    """Return the duration of a full oscillation."""
    return float(4 * ellipk(np.sin(amplitude / 2) ** 2) * np.sqrt(length / gravity))


def motion(
    times: ArrayLike, length: float = 1.0, gravity: float = 9.81, amplitude: float = np.pi / 2
) -> tuple[Array, Array]:
    """Return the angle and the angular velocity of a simple pendulum.

    Parameters
    ----------
    times : array_like
        Times since the release.
    length, gravity : float
        Length of the pendulum, acceleration of gravity.
    amplitude : float
        Angle at the release, -pi < amplitude < pi; pi/2 is the horizontal at x = +length.

    Returns
    -------
    angle, rate : ndarray
        Angle from the lowest position, and its derivative.
    """
    k, w0 = np.sin(amplitude / 2), np.sqrt(gravity / length)
    # The elliptic functions lose digits at large arguments: whole periods are dropped first.
    reduced = np.remainder(np.asarray(times, dtype=float), period(length, gravity, amplitude))
    sn, cn, dn, _ = ellipj(w0 * reduced, k**2)
    complement = np.cos(amplitude / 2)
    # atan2 keeps the digits that arcsin loses near the amplitude: cos(angle/2) = k'/dn.
    angle = 2 * np.arctan2(k * cn / dn, complement / dn)
    return angle, -2 * k * complement * w0 * sn / dn


def position(
    times: ArrayLike, length: float = 1.0, gravity: float = 9.81, amplitude: float = np.pi / 2
) -> tuple[Array, Array]:
    """Return the coordinates x and y of the bob of a simple pendulum; parameters as in `motion`."""
    angle, _ = motion(times, length, gravity, amplitude)
    return length * np.sin(angle), -length * np.cos(angle)


def equivalent_length(mass: float, distance: float, inertia: float) -> float:
    """Return the length of the simple pendulum that moves like a physical one.

    Parameters
    ----------
    mass, distance : float
        Mass, distance of the centre of mass from the pivot.
    inertia : float
        Moment of inertia about the centre of mass.
    """
    return distance + inertia / (mass * distance)


def physical_position(
    times: ArrayLike,
    mass: float,
    distance: float,
    inertia: float,
    gravity: float = 9.81,
    amplitude: float = np.pi / 2,
) -> tuple[Array, Array]:
    """Return the coordinates x and y of the centre of mass; parameters as in `equivalent_length` and `motion`."""
    angle, _ = motion(times, equivalent_length(mass, distance, inertia), gravity, amplitude)
    return distance * np.sin(angle), -distance * np.cos(angle)
