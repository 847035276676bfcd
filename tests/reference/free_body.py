"""Free rotation of a rigid body, and the heavy symmetric top.

Quaternions are (scalar, x, y, z) and turn components on body axes into components on inertial axes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipj

Array = NDArray[np.float64]


def rotation_matrix(quaternion: ArrayLike) -> Array:
    """Return the matrix that turns components on body axes into components on inertial axes."""
    q = np.asarray(quaternion, dtype=float)
    s, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - s * z), 2 * (x * z + s * y)],
            [2 * (x * y + s * z), 1 - 2 * (x * x + z * z), 2 * (y * z - s * x)],
            [2 * (x * z - s * y), 2 * (y * z + s * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion_rate(quaternion: Array, w: Array) -> Array:
    """Return the derivative of a quaternion for an angular velocity on body axes: q (0, w) / 2."""
    scalar, vector = quaternion[0], quaternion[1:]
    return np.concatenate([[-vector @ w], scalar * w + np.cross(vector, w)]) / 2


def torque_free(
    inertia: ArrayLike, w: ArrayLike, times: ArrayLike, quaternion: ArrayLike = (1.0, 0.0, 0.0, 0.0)
) -> tuple[Array, Array]:
    """Integrate Euler's equations of a body without torque.

    Parameters
    ----------
    inertia : array_like
        Three principal moments of inertia about the centre of mass.
    w : array_like
        Angular velocity on body axes at times[0].
    times : array_like
        Increasing times of the result.
    quaternion : array_like
        Orientation at times[0].

    Returns
    -------
    w, quaternion : ndarray of shape (len(times), 3) and (len(times), 4)
        Angular velocity on body axes, orientation.
    """
    principal, times = np.asarray(inertia, dtype=float), np.asarray(times, dtype=float)

    def derivative(_: float, state: Array) -> Array:
        rate = state[:3]
        return np.concatenate([-np.cross(rate, principal * rate) / principal, quaternion_rate(state[3:], rate)])

    start = np.concatenate([np.asarray(w, dtype=float), np.asarray(quaternion, dtype=float)])
    solution = solve_ivp(derivative, times[[0, -1]], start, "DOP853", times, rtol=1e-12, atol=1e-13)
    return solution.y[:3].T, solution.y[3:].T


def torque_free_rate(inertia: ArrayLike, w1: float, w3: float, times: ArrayLike) -> Array:
    """Return the angular velocity of an asymmetric top that starts at time 0 with (w1, 0, w3).

    Landau and Lifshitz, Mechanics, eq. 37.8-37.10.

    Parameters
    ----------
    inertia : array_like
        Principal moments, I1 < I2 < I3.
    w1, w3 : float
        Angular velocity about the axes of the least and of the greatest moment; not 0.
    times : array_like
        Times of the result.

    Returns
    -------
    ndarray of shape (len(times), 3)
        Angular velocity on body axes.
    """
    I1, I2, I3 = np.asarray(inertia, dtype=float)
    t = np.asarray(times, dtype=float)
    modulus = (I2 - I1) * I1 * w1**2 / ((I3 - I2) * I3 * w3**2)
    if modulus <= 1:
        sn, cn, dn, _ = ellipj(t * abs(w3) * np.sqrt((I3 - I2) * (I3 - I1) / (I1 * I2)), modulus)
        middle = w1 * np.sign(w3) * np.sqrt(I1 * (I3 - I1) / (I2 * (I3 - I2)))
        return np.column_stack([w1 * cn, middle * sn, w3 * dn])
    sn, cn, dn, _ = ellipj(t * abs(w1) * np.sqrt((I2 - I1) * (I3 - I1) / (I2 * I3)), 1 / modulus)
    middle = w3 * np.sign(w1) * np.sqrt(I3 * (I3 - I1) / (I2 * (I2 - I1)))
    return np.column_stack([w1 * dn, middle * sn, w3 * cn])


def heavy_top(
    transverse: float, axial: float, weight_moment: float, start: ArrayLike, spin: float, times: ArrayLike
) -> Array:
    """Integrate the nutation and precession of a symmetric top with a fixed point.

    The vertical is +y (gravity along -y). Lagrange's equations with the two cyclic momenta, Goldstein 5.7.

    Parameters
    ----------
    transverse, axial : float
        Moments of inertia about the fixed point, across and along the axis of symmetry.
    weight_moment : float
        Mass times gravity times distance of the centre of mass from the fixed point.
    start : array_like
        Inclination from the vertical (not 0), its rate, and the rate of precession, at times[0].
    spin : float
        Component of the angular velocity along the axis of symmetry (constant).
    times : array_like
        Increasing times of the result.

    Returns
    -------
    ndarray of shape (len(times), 6)
        Inclination, precession, own rotation, and their rates; precession and own rotation start at 0.
    """
    theta0, theta_rate0, precession0 = np.asarray(start, dtype=float)
    times = np.asarray(times, dtype=float)
    momentum = transverse * precession0 * np.sin(theta0) ** 2 + axial * spin * np.cos(theta0)

    def precession_rate(theta: Array | float) -> Array:
        return np.asarray((momentum - axial * spin * np.cos(theta)) / (transverse * np.sin(theta) ** 2))

    def derivative(_: float, state: Array) -> Array:
        theta, theta_rate = state[:2]
        rate = precession_rate(theta)
        moment = np.sin(theta) * (transverse * rate**2 * np.cos(theta) - axial * spin * rate + weight_moment)
        return np.array([theta_rate, moment / transverse, rate, spin - rate * np.cos(theta)])

    first = [theta0, theta_rate0, 0.0, 0.0]
    solution = solve_ivp(derivative, times[[0, -1]], first, "DOP853", times, rtol=1e-12, atol=1e-13)
    theta, theta_rate, precession, rotation = solution.y
    rate = precession_rate(theta)
    return np.column_stack([theta, precession, rotation, theta_rate, rate, spin - rate * np.cos(theta)])


def top_axis(theta: ArrayLike, precession: ArrayLike) -> Array:
    """Return the axis of symmetry: in the xy plane towards +x at precession 0, turning anticlockwise about +y."""
    theta, precession = np.asarray(theta), np.asarray(precession)
    return np.stack([np.sin(theta) * np.cos(precession), np.cos(theta), -np.sin(theta) * np.sin(precession)], axis=-1)


def steady_precession(
    transverse: float, axial: float, weight_moment: float, theta: float, spin: float
) -> tuple[float, float]:
    """Return the slow and the fast rate of precession at constant inclination (parameters as in `heavy_top`).

    Roots of transverse cos(theta) r**2 - axial spin r + weight_moment = 0; theta is not pi/2.
    """
    b = axial * spin
    root = np.sqrt(b**2 - 4 * transverse * np.cos(theta) * weight_moment)
    # Both roots without the cancellation of the usual formula.
    large = b + np.copysign(root, b)
    return float(2 * weight_moment / large), float(large / (2 * transverse * np.cos(theta)))
