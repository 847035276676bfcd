"""Exact integrals of the planar Euler-Bernoulli beam element, for machines derived by hand.

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
        Integrals of S1 and S2, the axial and transverse shape functions; n = 3 (N + 1).
    x1, x2 : arrays, shape (n,)
        Integrals of x S1 and x S2.
    M11, M12, M22 : arrays, shape (n, n)
        Integrals of S1' S1, S1' S2, S2' S2.
    K_axial, K_bending : arrays, shape (n, n)
        Integrals of S1'' S1' and S2'''' S2'' (first and second derivatives), factors EA/l and EJ/l^3.
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


def _integral(polynomial: Polynomial) -> float:
    """Integral from 0 to 1."""
    coefficients = np.asarray(polynomial.coef)
    return np.dot(COMMON // np.arange(1, coefficients.size + 1), coefficients) / COMMON


def _vector(row: Row, weight: Polynomial) -> np.ndarray:
    return np.array([_integral(s * weight) for s in row])


def _matrix(left: Row, right: Row, order: int = 0) -> np.ndarray:
    return np.array([[_integral(p.deriv(order) * q.deriv(order)) for q in right] for p in left])


@cache
def element_matrices() -> BeamMatrices:
    """Return the integrals of one element."""
    return BeamMatrices(
        s1=_vector(ALONG, ONE),
        s2=_vector(ACROSS, ONE),
        x1=_vector(ALONG, xi),
        x2=_vector(ACROSS, xi),
        M11=_matrix(ALONG, ALONG),
        M12=_matrix(ALONG, ACROSS),
        M22=_matrix(ACROSS, ACROSS),
        K_axial=_matrix(ALONG, ALONG, 1),
        K_bending=_matrix(ACROSS, ACROSS, 2),
    )


@cache
def beam_matrices(elements: int) -> BeamMatrices:
    """Assemble the integrals of a beam (equation 11): element j is between nodes j and j + 1, with its root at x = j."""
    one, n = element_matrices(), 3 * (elements + 1)
    vectors = {name: np.zeros(n) for name in ("s1", "s2", "x1", "x2")}
    matrices = {name: np.zeros((n, n)) for name in ("M11", "M12", "M22", "K_axial", "K_bending")}
    for j in range(elements):
        dofs = np.arange(3 * j, 3 * j + 6)
        for name, total in vectors.items():
            shifted = j * getattr(one, "s" + name[1]) if name[0] == "x" else 0
            total[dofs] += getattr(one, name) + shifted
        for name, total in matrices.items():
            total[np.ix_(dofs, dofs)] += getattr(one, name)
    return BeamMatrices(**vectors, **matrices)
