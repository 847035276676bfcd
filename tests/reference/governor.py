"""Flyball governor, symmetric: shaft angle psi, height s of the slider, angle th of the rods below the horizontal.

Lagrange: I th'' = J'(th) W^2 / 2 - V_th - 2 F l_th and m s'' = -m g - 2 F l_s, where F is the force of each
spring-damper of length l(s, th); the angular momentum p = J(th) W about the shaft is a constant, which gives W = psi'.
"""

from __future__ import annotations

import numpy as np
from numpy import cos, sin
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
GRAVITY, OFFSET, BALL, K, C, L0 = 9.81, 0.05, 5.0, 8e5, 4e4, 0.5
DENSITY, SIDE, CUBE = 3000.0, 0.01, 0.1
ROD, SLIDER = DENSITY * SIDE**2, DENSITY * CUBE**3
ALONG, ACROSS = ROD * SIDE**2 / 6, ROD * (1 + SIDE**2) / 12
SWING = 2 * (ROD / 4 + ACROSS + BALL)


def spin_inertia(th: float | Array) -> tuple[Array, Array]:
    """Return the moment of inertia about the shaft, and its derivative with respect to th."""
    c, s = np.asarray(cos(th)), np.asarray(sin(th))
    still = ALONG + SLIDER * CUBE**2 / 6
    rods = ROD * (OFFSET + c / 2) ** 2 + ACROSS * c**2 + ALONG * s**2
    rods_th = -ROD * (OFFSET + c / 2) * s + 2 * (ALONG - ACROSS) * c * s
    return still + 2 * rods + 2 * BALL * (OFFSET + c) ** 2, 2 * rods_th - 4 * BALL * (OFFSET + c) * s


def spring(s: float, th: float) -> tuple[float, float, float]:
    """Return the length of a spring-damper and its derivatives with respect to s and th."""
    x, z = cos(th) / 2, 1 - sin(th) / 2 - s
    length = np.hypot(x, z)
    return length, -z / length, (-x * sin(th) / 2 - z * cos(th) / 2) / length


def simulate(times: ArrayLike, angle: float = np.pi / 6, spin: float = 2 * np.pi, height: float = 0.5) -> Array:
    """Integrate the motion from the start, where slider and rods do not move relative to the shaft.

    Parameters
    ----------
    times : array_like
        Increasing times from the start.
    angle, spin, height : float
        th, W and s at the start.

    Returns
    -------
    ndarray of shape (len(times), 5)
        s, th, psi, s', th' at each time.
    """
    times = np.asarray(times, dtype=float)
    momentum = spin_inertia(angle)[0] * spin

    def derivative(_: float, state: Array) -> list[float]:
        s, th, _, s_v, th_v = state
        J, J_th = spin_inertia(th)
        W = momentum / J
        length, l_s, l_th = spring(s, th)
        F = K * (length - L0) + C * (l_s * s_v + l_th * th_v)
        weight = 2 * GRAVITY * (ROD / 2 + BALL) * cos(th)
        return [
            s_v,
            th_v,
            W,
            -GRAVITY - 2 * F * l_s / SLIDER,
            (J_th * W**2 / 2 + weight - 2 * F * l_th) / SWING,
        ]

    start = [height, angle, 0.0, 0.0, 0.0]
    # LSODA rather than DOP853: the spring-dampers decay at 10^4 / s.
    return solve_ivp(derivative, (0.0, times[-1]), start, "LSODA", times, rtol=1e-11, atol=1e-13).y.T


def energy(states: Array, angle: float = np.pi / 6, spin: float = 2 * np.pi) -> Array:
    """Return kinetic, elastic and potential energy of states as returned by `simulate`."""
    s, th, _, s_v, th_v = states.T
    momentum = spin_inertia(angle)[0] * spin
    kinetic = momentum**2 / spin_inertia(th)[0] / 2 + SWING * th_v**2 / 2 + SLIDER * s_v**2 / 2
    lengths = np.hypot(cos(th) / 2, 1 - sin(th) / 2 - s)
    height = SLIDER * s + 2 * ROD * (1 - sin(th) / 2) + 2 * BALL * (1 - sin(th))
    return kinetic + K * (lengths - L0) ** 2 + GRAVITY * height
