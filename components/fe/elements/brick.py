"""Eight-node brick with incompatible modes, statically condensed: it bends without locking.

Taylor, Beresford and Wilson, "A non-conforming element for stress analysis", Int. J. Num. Meth. Eng. 10 (1976): the
displacement contains 1 - xi^2, 1 - eta^2, 1 - zeta^2 in addition to the eight shape functions. Their gradients use the
Jacobian at the centre, so that elements of any shape pass the patch test. They have no mass.
"""

from __future__ import annotations

import numpy as np

from acausal import DeclarationError
from components.fe.elements.material import Material

CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], dtype=float
)
POINTS = CORNERS / np.sqrt(3)  # Gauss points of weight 1


def shapes(at: np.ndarray) -> np.ndarray:
    """Return the eight shape functions at a point of the reference cube, shape (8,)."""
    return np.prod(1 + CORNERS * at, axis=1) / 8


def slopes(at: np.ndarray) -> np.ndarray:
    """Return the derivatives of the shape functions by xi, eta, zeta, shape (8, 3)."""
    parts = 1 + CORNERS * at
    others = [parts[:, 1] * parts[:, 2], parts[:, 0] * parts[:, 2], parts[:, 0] * parts[:, 1]]
    return CORNERS * np.stack(others, axis=1) / 8


def matrices(points: np.ndarray, cells: np.ndarray, material: Material) -> tuple[np.ndarray, np.ndarray]:
    """Return the consistent mass and condensed stiffness matrices of the bricks.

    Parameters
    ----------
    points : array, shape (N, 3)
        Positions of the nodes in m.
    cells : array, shape (elements, 8)
        Nodes of each brick: one face, then the opposite one in the same order.
    material : Material
        The solid.

    Returns
    -------
    mass : array, shape (elements, 8, 8)
        In kg, the same for each direction.
    stiffness : array, shape (elements, 8, 3, 8, 3)
        In N/m.
    """
    mass, full = integrals(points, cells, material)
    corner, cross, inner = full[:, :24, :24], full[:, :24, 24:], full[:, 24:, 24:]
    condensed = corner - cross @ np.linalg.solve(inner, cross.transpose(0, 2, 1))
    return mass, condensed.reshape(len(cells), 8, 3, 8, 3)


def incompatible(points: np.ndarray, cells: np.ndarray, material: Material) -> np.ndarray:
    """Return the map from corner displacements to amplitudes of incompatible modes, shape (elements, 3, 3, 8, 3)."""
    _, full = integrals(points, cells, material)
    return -np.linalg.solve(full[:, 24:, 24:], full[:, 24:, :24]).reshape(len(cells), 3, 3, 8, 3)


def gradients(corners: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the gradients of shape functions and incompatible modes at a point of the reference cube.

    Parameters
    ----------
    corners : array, shape (elements, 8, 3)
        Positions of the corners in m.
    at : array, shape (3,)
        Point, coordinates from -1 to 1.

    Returns
    -------
    gradients : array, shape (elements, 11, 3)
        In 1/m.
    weight : array, shape (elements,)
        Determinant of the Jacobian in m3.
    """
    centre = np.einsum("eia,ix->eax", corners, slopes(np.zeros(3)))
    jacobian = np.einsum("eia,ix->eax", corners, slopes(at))
    weight = np.linalg.det(jacobian)
    own = np.einsum("ix,exa->eia", slopes(at), np.linalg.inv(jacobian))
    bubbles = -2 * at[None, :, None] * np.linalg.inv(centre) * (np.linalg.det(centre) / weight)[:, None, None]
    return np.concatenate([own, bubbles], axis=1), weight


def integrals(points: np.ndarray, cells: np.ndarray, material: Material) -> tuple[np.ndarray, np.ndarray]:
    """Return the mass, shape (elements, 8, 8), and the stiffness before condensation, (elements, 33, 33)."""
    corners = points[cells]
    mass = np.zeros((len(cells), 8, 8))
    products = np.zeros((3, 3, len(cells), 11, 11))
    for at in POINTS:
        volume = np.linalg.det(np.einsum("eia,ix->eax", corners, slopes(at)))
        if (volume <= 0).any():
            wrong = int(np.flatnonzero(volume <= 0)[0])
            raise DeclarationError(
                f"the brick of nodes {cells[wrong].tolist()} is inverted: its Jacobian determinant is not positive"
            )
        both, weight = gradients(corners, at)
        mass += material.rho * weight[:, None, None] * np.outer(shapes(at), shapes(at))
        products += np.einsum("e,eia,ejb->abeij", weight, both, both)
    return mass, material.stiffness(products).transpose(2, 3, 0, 4, 1).reshape(len(cells), 33, 33)
