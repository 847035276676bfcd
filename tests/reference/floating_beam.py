"""Flexible Euler-Bernoulli beam in a floating frame, by quadrature over material points.

The frame and the beam move in space: the point at x is at r = (x + u, v, w) on frame axes, u linear, v and w cubic (Hermite)
in each of equal elements; sections turn by the linear angle phi about x. Nodal coordinates, root node first: (u, v, v', w,
w', phi) per node, 6 (elements + 1) values. The generalised forces follow from d'Alembert's principle with the acceleration
of each point, and nothing is integrated in closed form. Vectors are components on frame axes.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Stiffness = tuple[float, float, float, float]  # EA, EJ_z (bending in xy), EJ_y (bending in xz), GJ_t

NODE = 6
# r x acc is of degree 6 in x: four points are exact up to degree 7.
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)
_E_X = np.array([1.0, 0.0, 0.0])


def nodal(deflections: ArrayLike) -> Array:
    """Return the nodal coordinates of displacements and rotation vectors (phi, -w', v') of the nodes, shape (..., nodes, 6)."""
    rows = np.asarray(deflections, dtype=float)
    found = rows[..., [0, 1, 5, 2, 4, 3]] * [1, 1, 1, 1, -1, 1]
    return found.reshape(*rows.shape[:-2], -1)


def shape(length: float, elements: int, x: float, element: int | None = None) -> Array:
    """Return the matrix S of (u, v, w) = S q at x, of shape (3, 6 (elements + 1)).

    `element` is found from x if not given.
    """
    return _shape(length, elements, x, element)[:3]


def _shape(length: float, elements: int, x: float, element: int | None = None) -> Array:
    """Return the matrix of (u, v, w, phi) at x."""
    h = length / elements
    e = min(int(x / h), elements - 1) if element is None else element
    s = x / h - e
    S = np.zeros((4, NODE * elements + NODE))
    hermite = 1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)
    for row, (ends, values) in enumerate(_places(e, (1 - s, s), hermite)):
        S[row, ends] = values
    return S


def _strain(length: float, elements: int, x: float, element: int) -> Array:
    """Return the matrix B of (u', v'', w'', phi') = B q at x."""
    h, e = length / elements, element
    s = x / h - e
    B = np.zeros((4, NODE * elements + NODE))
    curvature = (12 * s - 6) / h**2, (6 * s - 4) / h, (6 - 12 * s) / h**2, (6 * s - 2) / h
    for row, (ends, values) in enumerate(_places(e, (-1 / h, 1 / h), curvature)):
        B[row, ends] = values
    return B


def _places(e: int, along: tuple, across: tuple) -> list[tuple[list[int], tuple]]:
    """Indices of the nodal coordinates of element e for u, v, w and phi, and values there."""
    k = NODE * e
    u, v, w, phi = ([k + i, k + NODE + i] for i in (0, 1, 3, 5))
    v, w = ([i, i + 1, j, j + 1] for i, j in (v, w))
    return [(u, along), (v, across), (w, across), (phi, along)]


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
        Nodal coordinates and their derivatives, 6 (elements + 1) values.
    a, z, w : array_like
        Acceleration of the frame's origin, angular acceleration and angular velocity of the frame (absolute).
    g : array_like
        Acceleration of gravity.
    torsional_inertia : float
        Moment of inertia of the cross-sections about the local x axis, rho (J + J_y) length, with the speed w_x + phi'.

    Returns
    -------
    force, moment : ndarray of 3
        Resultant of rho_A (acc - g), and its moment about the frame's origin.
    nodal : ndarray of 6 (elements + 1)
        Generalised forces of the nodal coordinates.
    """
    q, qd, qdd, a, z, w, g = (np.asarray(value, dtype=float) for value in (q, qd, qdd, a, z, w, g))
    force, moment, nodal = np.zeros(3), np.zeros(3), np.zeros(NODE * elements + NODE)
    for e, x, dx in _quadrature(length, elements):
        S, phi = np.split(_shape(length, elements, x, e), [3])
        r = x * _E_X + S @ q
        acc = a + np.cross(z, r) + np.cross(w, np.cross(w, r)) + 2 * np.cross(w, S @ qd) + S @ qdd - g
        df, dI = rho_A * dx * acc, torsional_inertia * dx / length
        turning = z[0] + phi[0] @ qdd
        force += df
        moment += np.cross(r, df) + dI * (turning * _E_X + np.cross(w, (w[0] + phi[0] @ qd) * _E_X))
        nodal += S.T @ df + phi[0] * dI * turning
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
    total = 0.0
    for dm, dI, _, velocity, spin in _moving_points(length, rho_A, elements, q, qd, v, w, torsional_inertia):
        total += dm * velocity @ velocity / 2 + dI * spin**2 / 2
    return float(total)


def micro_energy(length: float, rho_A: float, elements: int, qd: ArrayLike, torsional_inertia: float = 0.0) -> float:
    """Return the energy of the mean of consistent and lumped inertia against stretch and torsion, less the consistent one.

    Of an element with the mass m, m (u_1'^2 + u_2'^2) / 4 is the energy of lumped masses, m (u_1'^2 + u_1' u_2' + u_2'^2) / 6
    that of linear u'; half their difference is m (u_2' - u_1')^2 / 24.
    """
    apart = np.diff(np.asarray(qd, dtype=float).reshape(-1, NODE), axis=0)
    m, inertia = rho_A * length / elements, torsional_inertia / elements
    return float(m * apart[:, 0] @ apart[:, 0] + inertia * apart[:, 5] @ apart[:, 5]) / 24


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
    momentum, angular = np.zeros(3), np.zeros(3)
    for dm, dI, r, velocity, spin in _moving_points(length, rho_A, elements, q, qd, v, w, torsional_inertia):
        momentum += dm * velocity
        angular += dm * np.cross(r, velocity) + dI * spin * _E_X
    return momentum, angular


def _moving_points(
    length: float,
    rho_A: float,
    elements: int,
    q: ArrayLike,
    qd: ArrayLike,
    v: ArrayLike,
    w: ArrayLike,
    torsional_inertia: float,
) -> Iterator[tuple[float, float, Array, Array, float]]:
    """Yield mass, moment of inertia about x, position, absolute velocity and speed about x of each Gauss point."""
    q, qd, v, w = (np.asarray(value, dtype=float) for value in (q, qd, v, w))
    for e, x, dx in _quadrature(length, elements):
        S, phi = np.split(_shape(length, elements, x, e), [3])
        r = x * _E_X + S @ q
        spin = float(w[0] + phi[0] @ qd)
        yield rho_A * dx, torsional_inertia * dx / length, r, v + np.cross(w, r) + S @ qd, spin


def stiffness_forces(length: float, stiffness: Stiffness, elements: int, q: ArrayLike) -> Array:
    """Return K q, the elastic generalised forces of the nodal coordinates."""
    forces = np.zeros(NODE * elements + NODE)
    for e, x, dx in _quadrature(length, elements):
        B = _strain(length, elements, x, e)
        forces += dx * B.T @ (np.array(stiffness) * (B @ np.asarray(q, dtype=float)))
    return forces


def elastic_energy(length: float, stiffness: Stiffness, elements: int, q: ArrayLike) -> float:
    """Return the integral of (EA u'^2 + EJ_z v''^2 + EJ_y w''^2 + GJ_t phi'^2) / 2."""
    total = 0.0
    for e, x, dx in _quadrature(length, elements):
        strain = _strain(length, elements, x, e) @ np.asarray(q, dtype=float)
        total += dx * (np.array(stiffness) @ strain**2) / 2
    return float(total)
