"""Cantilever on a hub of no radius that turns steadily: frequencies of bending, by the method of Ritz.

Length, mass per length and bending stiffness are 1. The axial force of the inextensible beam, speed^2 (1 - x^2) / 2, works on
half the square of the slope; in the plane of rotation the centrifugal force lessens the stiffness by speed^2 times the mass.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import Legendre, Polynomial
from numpy.typing import NDArray
from scipy.linalg import eigh

SHAPES = 16  # of degree 2 to 17: more change nothing up to speed 12


def frequencies(speed: float, in_plane: bool, count: int) -> NDArray[np.float64]:
    """Return the first angular frequencies, seen by one who turns with the hub."""
    points, weights = np.polynomial.legendre.leggauss(2 * SHAPES)
    x, w = (points + 1) / 2, weights / 2
    # x^2 times polynomials that are orthogonal on the beam: clamped at the root.
    shapes = [Polynomial([0, 0, 1]) * Legendre.basis(k, domain=[0, 1]).convert(kind=Polynomial) for k in range(SHAPES)]
    v, slope, bend = (np.array([p.deriv(order)(x) for p in shapes]) for order in (0, 1, 2))
    mass = (v * w) @ v.T
    stiffness = (bend * w) @ bend.T + (slope * w * speed**2 * (1 - x**2) / 2) @ slope.T
    squares = eigh(stiffness, mass, eigvals_only=True)[:count]
    return np.sqrt(squares - speed**2 * in_plane)
