"""Flexible Euler-Bernoulli beam in a floating frame, by quadrature over material points.

The frame moves in space; the beam deforms in its xy plane: the point at x is at u = (x + u1, u2, 0) on frame axes, u1
linear and u2 cubic (Hermite) in each of equal elements. Nodal coordinates, root node first: (u1, u2, rotation) per
node, 3 (elements + 1) values. The generalised forces follow from d'Alembert's principle with the acceleration of each
point, and nothing is integrated in closed form. Vectors are components on frame axes.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

# u x acc is of degree 6 in x: four points are exact up to degree 7.
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)
_E_X = np.array([1.0, 0.0, 0.0])


def shape(length: float, elements: int, x: float, element: int | None = None) -> Array:
    """Return the matrix S of (u1, u2, 0) = S q at x, of shape (3, 3 (elements + 1)).

    `element` is found from x if not given.
    """
    h = length / elements
    e = min(int(x / h), elements - 1) if element is None else element
    s = x / h - e
    S = np.zeros((3, 3 * elements + 3))
    S[0, [3 * e, 3 * e + 3]] = 1 - s, s
    hermite = 1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)
    S[1, [3 * e + 1, 3 * e + 2, 3 * e + 4, 3 * e + 5]] = hermite
    return S


def _strain(length: float, elements: int, x: float, element: int) -> Array:
    """Return the matrix B of (u1', u2'') = B q at x."""
    h, e = length / elements, element
    s = x / h - e
    B = np.zeros((2, 3 * elements + 3))
    B[0, [3 * e, 3 * e + 3]] = -1 / h, 1 / h
    curvature = (12 * s - 6) / h**2, (6 * s - 4) / h, (6 - 12 * s) / h**2, (6 * s - 2) / h
    B[1, [3 * e + 1, 3 * e + 2, 3 * e + 4, 3 * e + 5]] = curvature
    return B


def _quadrature(length: float, elements: int) -> Iterator[tuple[int, float, float]]:
    """Yield element, position and weight of each Gauss point."""
    h = length / elements
    for e in range(elements):
        for point, weight in zip(_POINTS, _WEIGHTS, strict=True):
            yield e, h * (e + (1 + point) / 2), h * weight / 2


def inertia_forces(
    length: float,
    rho_A: float,
    elements: int,
    q: ArrayLike,
    qd: ArrayLike,
    qdd: ArrayLike,
    a: ArrayLike,
    z: ArrayLike,
    w: ArrayLike,
    g: ArrayLike,
    torsional_inertia: float = 0.0,
) -> tuple[Array, Array, Array]:
    """Return the forces that give the beam its motion against inertia and gravity.

    Parameters
    ----------
    length, rho_A : float
        Length, mass per length.
    elements : int
        Number of equal elements.
    q, qd, qdd : array_like
        Nodal coordinates and their derivatives, 3 (elements + 1) values.
    a, z, w : array_like
        Acceleration of the frame's origin, angular acceleration and angular velocity of the frame (absolute).
    g : array_like
        Acceleration of gravity.
    torsional_inertia : float
        Moment of inertia of the cross-sections about the local x axis, rho (J + J_y) length; rigid.

    Returns
    -------
    force, moment : ndarray of 3
        Resultant of rho_A (acc - g), and its moment about the frame's origin.
    nodal : ndarray of 3 (elements + 1)
        Generalised forces of the nodal coordinates.
    """
    q, qd, qdd, a, z, w, g = (np.asarray(value, dtype=float) for value in (q, qd, qdd, a, z, w, g))
    force, nodal = np.zeros(3), np.zeros(3 * elements + 3)
    moment = torsional_inertia * (z[0] * _E_X + np.cross(w, w[0] * _E_X))
    for e, x, dx in _quadrature(length, elements):
        S = shape(length, elements, x, e)
        u = x * _E_X + S @ q
        acc = a + np.cross(z, u) + np.cross(w, np.cross(w, u)) + 2 * np.cross(w, S @ qd) + S @ qdd - g
        df = rho_A * dx * acc
        force += df
        moment += np.cross(u, df)
        nodal += S.T @ df
    return force, moment, nodal


def kinetic_energy(
    length: float,
    rho_A: float,
    elements: int,
    q: ArrayLike,
    qd: ArrayLike,
    v: ArrayLike,
    w: ArrayLike,
    torsional_inertia: float = 0.0,
) -> float:
    """Return the kinetic energy; v is the velocity of the frame's origin, else as in `inertia_forces`."""
    total = torsional_inertia * np.asarray(w, dtype=float)[0] ** 2 / 2
    for dm, _, velocity in _moving_points(length, rho_A, elements, q, qd, v, w):
        total += dm * velocity @ velocity / 2
    return float(total)


def momenta(
    length: float,
    rho_A: float,
    elements: int,
    q: ArrayLike,
    qd: ArrayLike,
    v: ArrayLike,
    w: ArrayLike,
    torsional_inertia: float = 0.0,
) -> tuple[Array, Array]:
    """Return the momentum, and the angular momentum about the frame's origin; parameters as in `kinetic_energy`."""
    momentum, angular = np.zeros(3), torsional_inertia * np.asarray(w, dtype=float)[0] * _E_X
    for dm, u, velocity in _moving_points(length, rho_A, elements, q, qd, v, w):
        momentum += dm * velocity
        angular += dm * np.cross(u, velocity)
    return momentum, angular


def _moving_points(
    length: float, rho_A: float, elements: int, q: ArrayLike, qd: ArrayLike, v: ArrayLike, w: ArrayLike
) -> Iterator[tuple[float, Array, Array]]:
    """Yield mass, position and absolute velocity of each Gauss point."""
    for e, x, dx in _quadrature(length, elements):
        S = shape(length, elements, x, e)
        u = x * _E_X + S @ np.asarray(q, dtype=float)
        yield rho_A * dx, u, np.asarray(v) + np.cross(np.asarray(w), u) + S @ np.asarray(qd, dtype=float)


def stiffness_forces(length: float, EA: float, EJ: float, elements: int, q: ArrayLike) -> Array:
    """Return K q, the elastic generalised forces of the nodal coordinates."""
    forces = np.zeros(3 * elements + 3)
    for e, x, dx in _quadrature(length, elements):
        B = _strain(length, elements, x, e)
        forces += dx * B.T @ (np.array([EA, EJ]) * (B @ np.asarray(q, dtype=float)))
    return forces


def elastic_energy(length: float, EA: float, EJ: float, elements: int, q: ArrayLike) -> float:
    """Return the integral of (EA u1'^2 + EJ u2''^2) / 2."""
    total = 0.0
    for e, x, dx in _quadrature(length, elements):
        strain = _strain(length, elements, x, e) @ np.asarray(q, dtype=float)
        total += dx * (np.array([EA, EJ]) @ strain**2) / 2
    return float(total)
