"""Clamped-free Euler-Bernoulli beam: exact and finite-element frequencies, static deflections, the roll-up."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigh
from scipy.optimize import brentq

Array = NDArray[np.float64]


def frequency_roots(count: int) -> Array:
    """Return the first positive roots of cos(b) cosh(b) = -1, 1.8751, 4.6941, ..."""

    def characteristic(b: float) -> float:
        return np.cos(b) + 1 / np.cosh(b)

    # One root in each interval of length pi.
    roots = [brentq(characteristic, n * np.pi, (n + 1) * np.pi, xtol=1e-14) for n in range(count)]
    return np.array(roots, dtype=float)


def bending_frequencies(length: float, rho_A: float, EJ: float, count: int) -> Array:
    """Return the first angular frequencies of bending in one plane."""
    return (frequency_roots(count) / length) ** 2 * np.sqrt(EJ / rho_A)


def axial_frequencies(length: float, rho_A: float, EA: float, count: int) -> Array:
    """Return the first angular frequencies of the clamped-free rod in extension."""
    return (np.arange(count) + 0.5) * np.pi / length * np.sqrt(EA / rho_A)


def bending_matrices(length: float, rho_A: float, EJ: float, elements: int) -> tuple[Array, Array]:
    """Return consistent mass and stiffness of cubic elements, clamped at the root.

    Przemieniecki, Theory of Matrix Structural Analysis, tables 5.2 and 11.1.

    Parameters
    ----------
    length, rho_A, EJ : float
        Length, mass per length, bending stiffness.
    elements : int
        Number of equal elements.

    Returns
    -------
    mass, stiffness : ndarray of shape (2 elements, 2 elements)
        For (deflection, rotation) of each node but the root.
    """
    h = length / elements
    mass = (rho_A * h / 420) * np.array(
        [
            [156, 22 * h, 54, -13 * h],
            [22 * h, 4 * h**2, 13 * h, -3 * h**2],
            [54, 13 * h, 156, -22 * h],
            [-13 * h, -3 * h**2, -22 * h, 4 * h**2],
        ]
    )
    stiffness = (EJ / h**3) * np.array(
        [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h**2, -6 * h, 2 * h**2],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h**2, -6 * h, 4 * h**2],
        ]
    )
    M, K = np.zeros((2, 2 * elements + 2, 2 * elements + 2))
    for i in range(0, 2 * elements, 2):
        M[i : i + 4, i : i + 4] += mass
        K[i : i + 4, i : i + 4] += stiffness
    return M[2:, 2:], K[2:, 2:]


def element_frequencies(length: float, rho_A: float, EJ: float, elements: int) -> Array:
    """Return all angular frequencies of bending of the finite-element beam, ascending."""
    M, K = bending_matrices(length, rho_A, EJ, elements)
    return np.sqrt(eigh(K, M, eigvals_only=True))


def tip_force_deflection(x: ArrayLike, length: float, EJ: float, force: float) -> tuple[Array, Array]:
    """Return deflection and slope at x under a small transverse force on the tip."""
    x = np.asarray(x, dtype=float)
    return force * x**2 * (3 * length - x) / (6 * EJ), force * x * (2 * length - x) / (2 * EJ)


def uniform_load_deflection(x: ArrayLike, length: float, EJ: float, load: float) -> tuple[Array, Array]:
    """Return deflection and slope at x under a small transverse load per length."""
    x = np.asarray(x, dtype=float)
    deflection = load * x**2 * (6 * length**2 - 4 * length * x + x**2) / (24 * EJ)
    return deflection, load * x * (3 * length**2 - 3 * length * x + x**2) / (6 * EJ)


def rolled_up(s: ArrayLike, EJ: float, moment: float) -> tuple[Array, Array, Array]:
    """Return x, y and the angle of the tangent at arc length s, bent into a circle by an end moment of any size.

    The beam is inextensible and lies along x before; the moment 2 pi EJ / length closes the circle.
    """
    s = np.asarray(s, dtype=float)
    angle = moment / EJ * s
    # sinc keeps the limit of no moment: sin(angle)/angle and (1 - cos(angle))/angle.
    chord = s * np.sinc(angle / (2 * np.pi))
    return chord * np.cos(angle / 2), chord * np.sin(angle / 2), angle
