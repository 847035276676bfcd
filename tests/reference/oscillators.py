"""Linear oscillators: one mass, and chains of masses or of torsional inertias, with springs and dampers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigh, expm

Array = NDArray[np.float64]


def spring_mass_damper(
    times: ArrayLike, mass: float, stiffness: float, damping: float, x0: float, v0: float, force: float = 0.0
) -> tuple[Array, Array]:
    """Return displacement and velocity of mass x'' + damping x' + stiffness x = force.

    Parameters
    ----------
    times : array_like
        Times since the start.
    mass, stiffness, damping : float
        Coefficients, stiffness > 0; any damping, also critical.
    x0, v0 : float
        Displacement and velocity at time 0.
    force : float
        Constant force.
    """
    t = np.asarray(times, dtype=float)
    rest = force / stiffness
    decay = damping / (2 * mass)
    split = np.sqrt(complex(decay**2 - stiffness / mass))
    # Exponentials are joined before they are added: exp(-decay t) cosh(split t) alone would overflow.
    up, down = np.exp((split - decay) * t), np.exp((-split - decay) * t)
    even = ((up + down) / 2).real
    odd = ((up - down) / (2 * split)).real if split else t * np.exp(-decay * t)
    displacement = x0 - rest
    x = rest + displacement * even + (v0 + decay * displacement) * odd
    v = v0 * even - (decay * v0 + stiffness / mass * displacement) * odd
    return x, v


def chain_matrix(coefficients: ArrayLike) -> Array:
    """Return the stiffness (or damping) matrix of a chain.

    Parameters
    ----------
    coefficients : array_like
        n + 1 values for n masses: wall to first mass, between neighbours, last mass to wall; 0 for a free end.
    """
    c = np.asarray(coefficients, dtype=float)
    return np.diag(c[:-1] + c[1:]) - np.diag(c[1:-1], 1) - np.diag(c[1:-1], -1)


def chain_frequencies(masses: ArrayLike, stiffnesses: ArrayLike) -> tuple[Array, Array]:
    """Return the angular frequencies, ascending, and the modes (columns, of unit modal mass) of an undamped chain.

    Parameters
    ----------
    masses : array_like
        n masses, or moments of inertia of a torsional chain.
    stiffnesses : array_like
        n + 1 stiffnesses as in `chain_matrix`.
    """
    squares, modes = eigh(chain_matrix(stiffnesses), np.diag(np.asarray(masses, dtype=float)))
    return np.sqrt(np.maximum(squares, 0.0)), modes


def chain_response(
    times: ArrayLike,
    masses: ArrayLike,
    stiffnesses: ArrayLike,
    dampings: ArrayLike,
    x0: ArrayLike,
    v0: ArrayLike,
    forces: ArrayLike | None = None,
) -> tuple[Array, Array]:
    """Return displacements and velocities of a chain, by the matrix exponential.

    An eigenvector basis would fail for free chains and for critical damping (the state matrix is defective).

    Parameters
    ----------
    times : array_like
        Times since the start.
    masses : array_like
        n masses, or moments of inertia of a torsional chain.
    stiffnesses, dampings : array_like
        n + 1 values each, as in `chain_matrix`.
    x0, v0 : array_like
        Displacements from the unstressed chain, and velocities, at time 0.
    forces : array_like, optional
        Constant forces (torques) on the masses.

    Returns
    -------
    x, v : ndarray of shape (len(times), n)
        Displacements and velocities.
    """
    m, start, speed = (np.asarray(value, dtype=float) for value in (masses, x0, v0))
    n = len(m)
    load = np.zeros(n) if forces is None else np.asarray(forces, dtype=float)
    # One more state, equal to 1, carries the constant forces.
    matrix = np.zeros((2 * n + 1, 2 * n + 1))
    matrix[:n, n : 2 * n] = np.eye(n)
    matrix[n : 2 * n, :n] = -chain_matrix(stiffnesses) / m[:, None]
    matrix[n : 2 * n, n : 2 * n] = -chain_matrix(dampings) / m[:, None]
    matrix[n : 2 * n, -1] = load / m
    exponentials = np.asarray(expm(np.asarray(times, dtype=float)[:, None, None] * matrix), dtype=float)
    states = exponentials @ np.concatenate([start, speed, [1.0]])
    return states[:, :n], states[:, n : 2 * n]
