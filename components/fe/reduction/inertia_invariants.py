"""Inertia invariants: mass integrals of node positions and modes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from components.fe.arrays import Array

# Entries set to 0, relative to the size of their mode. In symmetric bodies, entries that vanish by symmetry are below
# 1e-9 (plate of aspect ratio 100) and 1e-8 (rod of aspect ratio 200), the others above 1e-7.
ROUNDING = 1e-8


@dataclass(frozen=True)
class UsualInvariants:
    """The nine inertia invariants I1 to I9 of multibody programs; v~ is the skew-symmetric matrix of v.

    Parameters
    ----------
    I1 : float
        Mass.
    I2 : array, shape (3,)
        Integral of r0 dm.
    I3 : array, shape (3, n)
        Integrals of phi_b dm.
    I4 : array, shape (3, n)
        Integrals of r0 x phi_b dm.
    I5 : array, shape (n, 3, n)
        Integrals of phi_b x phi_c dm, at [b, :, c].
    I6 : array, shape (n, n)
        Integrals of phi_b . phi_c dm.
    I7 : array, shape (3, 3)
        Integral of r0~' r0~ dm, the inertia tensor about the origin.
    I8 : array, shape (n, 3, 3)
        Integrals of r0~ phi_b~ dm.
    I9 : array, shape (n, n, 3, 3)
        Integrals of phi_b~ phi_c~ dm.
    """

    I1: float
    I2: Array
    I3: Array
    I4: Array
    I5: Array
    I6: Array
    I7: Array
    I8: Array
    I9: Array


@dataclass(frozen=True)
class Invariants:
    """Mass integrals of the positions r0 and the modes phi_b; see `ReducedBody`.

    Parameters
    ----------
    mass, first_moment, second_moment, modal_first, modal_second, modal_products
        See `ReducedBody`.
    """

    mass: float
    first_moment: Array
    second_moment: Array
    modal_first: Array
    modal_second: Array
    modal_products: Array


def invariants(mass: Any, places: Array, modes: Array) -> Invariants:
    """Compute the mass integrals of positions and modes.

    The mass matrix is the Kronecker product of `mass` with the 3 x 3 unit matrix. With the shape functions N_i of the
    elements, mass_ij is the integral of N_i N_j dm, so a' mass b is the exact integral of two interpolated fields.

    Round-off is set to 0 entry by entry, relative to the two fields of an entry: |a' mass b| is at most
    sqrt(a' mass a) sqrt(b' mass b), so the thickness of a plate is judged separately from its length. The round-off of
    each component of a mode scales with the whole mode.

    Parameters
    ----------
    mass : sparse matrix, shape (N, N)
        Mass of each pair of nodes in kg.
    places : array, shape (N, 3)
        Node positions in m, relative to the origin of the reference frame.
    modes : array, shape (N, 3, n)
        Displacements of the modes.
    """
    n = modes.shape[2]
    fields = np.concatenate(
        [np.ones((len(places), 1)), places, modes.transpose(0, 2, 1).reshape(len(places), 3 * n)], axis=1
    )
    products = fields.T @ (mass @ fields)
    products = (products + products.T) / 2
    size = np.sqrt(np.maximum(np.diag(products), 0.0))
    # Components of a mode at round-off level of the mode.
    parts = size[4:].reshape(n, 3)
    parts[parts <= ROUNDING * np.linalg.norm(parts, axis=1, keepdims=True)] = 0.0
    whole = np.concatenate([size[:4], np.repeat(np.linalg.norm(parts, axis=1), 3)])
    bound = ROUNDING * np.maximum(np.outer(size, whole), np.outer(whole, size))
    products[np.abs(products) <= bound] = 0.0
    nothing = size == 0
    products[nothing], products[:, nothing] = 0.0, 0.0
    second = products[1:4, 4:].reshape(3, n, 3).transpose(1, 0, 2)
    # The integral of r0 x phi_b is a difference of two entries: set it to 0 if the difference is round-off.
    limit = bound[1:4, 4:].reshape(3, n, 3).transpose(1, 0, 2)
    turned = second.transpose(0, 2, 1)
    equal = np.abs(second - turned) <= limit + limit.transpose(0, 2, 1)
    second = np.where(equal, (second + turned) / 2, second)
    return Invariants(
        mass=float(products[0, 0]),
        first_moment=products[0, 1:4],
        second_moment=products[1:4, 1:4],
        modal_first=products[0, 4:].reshape(n, 3).T,
        modal_second=second,
        modal_products=products[4:, 4:].reshape(n, 3, n, 3).transpose(0, 2, 1, 3),
    )


def usual(body: Any) -> UsualInvariants:
    """Return I1 to I9 of a `ReducedBody` or `Invariants`.

    They all follow from A_b and B_bc, because u~ v~ = v u' - (u . v) E.
    """
    P, A, B, E = body.second_moment, body.modal_second, body.modal_products, np.eye(3)
    along = np.trace(B, axis1=2, axis2=3)
    return UsualInvariants(
        I1=body.mass,
        I2=body.first_moment,
        I3=body.modal_first,
        I4=axial(A).T,
        I5=axial(B).transpose(0, 2, 1),
        I6=along,
        I7=np.trace(P) * E - P,
        I8=A.transpose(0, 2, 1) - np.trace(A, axis1=1, axis2=2)[:, None, None] * E,
        I9=B.transpose(0, 1, 3, 2) - along[:, :, None, None] * E,
    )


def axial(products: Array) -> Array:
    """Return the integrals of u x v from those of u v', shape (..., 3, 3)."""
    P = products
    return np.stack([P[..., 1, 2] - P[..., 2, 1], P[..., 2, 0] - P[..., 0, 2], P[..., 0, 1] - P[..., 1, 0]], axis=-1)
