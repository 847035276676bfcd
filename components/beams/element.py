"""Exact integrals of the Euler-Bernoulli beam element.

Linear shape functions for the axial and Hermite cubics for the transverse displacement (Schiavo, Vigano, Ferretti 2006,
equation 6). The nodal coordinates U = (u, v, l theta) are in metres, with the element length l: the shape functions are
then dimensionless, and the mass l rho A and the stiffnesses E A / l and E J / l^3 are factors.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import Polynomial

Row = tuple[Polynomial, ...]

ZERO, ONE, xi = Polynomial([0]), Polynomial([1]), Polynomial([0, 1])
ALONG = (1 - xi, ZERO, ZERO, xi, ZERO, ZERO)
ACROSS = (ZERO, 1 - 3 * xi**2 + 2 * xi**3, xi - 2 * xi**2 + xi**3, ZERO, 3 * xi**2 - 2 * xi**3, xi**3 - xi**2)
COMMON = 420  # least common multiple of 1 to 7: exact common denominator of integer polynomials up to degree 6


@dataclass(frozen=True)
class BeamMatrices:
    """Assembled mass integrals of N elements, per element mass; x is measured in element lengths.

    Parameters
    ----------
    s1, s2 : arrays, shape (n,)
        Integrals of S1 and S2, the axial and transverse shape functions; n = 3 (N + 1) + bubbles.
    x1, x2 : arrays, shape (n,)
        Integrals of x S1 and x S2.
    M11, M12, M22 : arrays, shape (n, n)
        Integrals of S1' S1, S1' S2, S2' S2.
    K_axial, K_bending : arrays, shape (n, n)
        Integrals of S1'' S1' and S2'''' S2'' (first and second derivatives), factors EA/l and EJ/l^3.
    G : array, shape (n, n)
        Integral of S2'' S2' (first derivatives), factor 1/l.
    bubbles : int
        Number of axial bubble functions xi (1 - xi), at most one per element; the last entries of all arrays.
    """

    s1: np.ndarray
    s2: np.ndarray
    x1: np.ndarray
    x2: np.ndarray
    M11: np.ndarray
    M12: np.ndarray
    M22: np.ndarray
    K_axial: np.ndarray
    K_bending: np.ndarray
    G: np.ndarray
    bubbles: int = 0


def _integral(polynomial: Polynomial) -> float:
    """Integral from 0 to 1."""
    coefficients = np.asarray(polynomial.coef)
    return np.dot(COMMON // np.arange(1, coefficients.size + 1), coefficients) / COMMON


def _vector(row: Row, weight: Polynomial) -> np.ndarray:
    return np.array([_integral(s * weight) for s in row])


def _matrix(left: Row, right: Row, order: int = 0) -> np.ndarray:
    return np.array([[_integral(p.deriv(order) * q.deriv(order)) for q in right] for p in left])


@cache
def element_matrices(bubble: bool = False) -> BeamMatrices:
    """Return the integrals of one element."""
    along, across = (*ALONG, *[xi * (1 - xi)] * bubble), (*ACROSS, *[ZERO] * bubble)
    return BeamMatrices(
        s1=_vector(along, ONE),
        s2=_vector(across, ONE),
        x1=_vector(along, xi),
        x2=_vector(across, xi),
        M11=_matrix(along, along),
        M12=_matrix(along, across),
        M22=_matrix(across, across),
        K_axial=_matrix(along, along, 1),
        K_bending=_matrix(across, across, 2),
        G=_matrix(across, across, 1),
        bubbles=int(bubble),
    )


@cache
def beam_matrices(elements: int, bubbles: bool = False) -> BeamMatrices:
    """Assemble the integrals of a beam (equation 11): element j is between nodes j and j + 1, with its root at x = j."""
    one, n = element_matrices(bubbles), 3 * (elements + 1) + elements * bubbles
    vectors = {name: np.zeros(n) for name in ("s1", "s2", "x1", "x2")}
    matrices = {name: np.zeros((n, n)) for name in ("M11", "M12", "M22", "K_axial", "K_bending", "G")}
    for j in range(elements):
        dofs = np.array(element_dofs(j, elements, bubbles))
        for name, total in vectors.items():
            shifted = j * getattr(one, "s" + name[1]) if name[0] == "x" else 0
            total[dofs] += getattr(one, name) + shifted
        for name, total in matrices.items():
            total[np.ix_(dofs, dofs)] += getattr(one, name)
    return BeamMatrices(**vectors, **matrices, bubbles=elements * bubbles)


def element_dofs(j: int, elements: int, bubbles: bool) -> list[int]:
    """Indices of the coordinates of element j in those of the beam."""
    return [*range(3 * j, 3 * j + 6), *[3 * (elements + 1) + j] * bubbles]
