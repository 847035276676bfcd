"""Exact mass integrals of beam elements.

Linear shape functions for the displacement along the axis and Hermite cubics across it (Schiavo, Vigano, Ferretti 2006,
equation 6), of the nodal coordinates x + u along, and v, l v' across, in m: the shape functions are dimensionless, and the
mass of an element is a factor.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import Polynomial

Row = tuple[Polynomial, ...]

xi = Polynomial([0, 1])
ALONG = (1 - xi, xi)
ACROSS = (1 - 3 * xi**2 + 2 * xi**3, xi - 2 * xi**2 + xi**3, 3 * xi**2 - 2 * xi**3, xi**3 - xi**2)
BUBBLE = xi * (1 - xi)
COMMON = 420  # least common multiple of 1 to 7: exact common denominator of integer polynomials up to degree 6


@dataclass(frozen=True)
class BeamMatrices:
    """Assembled mass integrals of N elements, per mass of an element.

    Parameters
    ----------
    along : array, shape (N + 1 + bubbles, N + 1 + bubbles)
        Integrals of products of shape functions along, bubble functions last.
    mixed : array, shape (N + 1 + bubbles, 2 N + 2)
        Integrals of products of shape functions along and across.
    across : array, shape (2 N + 2, 2 N + 2)
        Integrals of products of shape functions across.
    """

    along: np.ndarray
    mixed: np.ndarray
    across: np.ndarray


def _integral(polynomial: Polynomial) -> float:
    """Integral from 0 to 1."""
    coefficients = np.asarray(polynomial.coef)
    return np.dot(COMMON // np.arange(1, coefficients.size + 1), coefficients) / COMMON


def _products(left: Row, right: Row) -> np.ndarray:
    return np.array([[_integral(p * q) for q in right] for p in left])


@cache
def beam_matrices(elements: int, bubbles: bool = False) -> BeamMatrices:
    """Assemble the integrals of a beam; element j lies between nodes j and j + 1."""
    along, across = (*ALONG, *[BUBBLE] * bubbles), ACROSS
    n, m = elements + 1 + elements * bubbles, 2 * elements + 2
    total = BeamMatrices(np.zeros((n, n)), np.zeros((n, m)), np.zeros((m, m)))
    for j in range(elements):
        rows, columns = places(j, elements, bubbles)
        total.along[np.ix_(rows, rows)] += _products(along, along)
        total.mixed[np.ix_(rows, columns)] += _products(along, across)
        total.across[np.ix_(columns, columns)] += _products(across, across)
    return total


def places(j: int, elements: int, bubbles: bool) -> tuple[list[int], list[int]]:
    """Return the positions of the coordinates of element j among those along, and across: first all v, then all l v'."""
    n = elements + 1
    return [j, j + 1, *[n + j] * bubbles], [j, n + j, j + 1, n + j + 1]
