"""Linear tetrahedron with four nodes (constant strain)."""

from __future__ import annotations

import numpy as np

from acausal import DeclarationError
from components.fe.elements.material import Material

_SLOPES = np.vstack([-np.ones(3), np.eye(3)])  # derivatives of the shape functions by the reference coordinates


def gradients(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Return the gradients of the shape functions in 1/m, shape (elements, 4, 3)."""
    return np.einsum("ix,exa->eia", _SLOPES, np.linalg.inv(_edges(points, cells)))


def _edges(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Return the Jacobian, whose columns are the edges from the first corner, shape (elements, 3, 3)."""
    return np.swapaxes(points[cells[:, 1:]] - points[cells[:, :1]], 1, 2)


def matrices(points: np.ndarray, cells: np.ndarray, material: Material) -> tuple[np.ndarray, np.ndarray]:
    """Return the consistent mass and stiffness matrices of the elements.

    Parameters
    ----------
    points : array, shape (N, 3)
        Positions of the nodes in m.
    cells : array, shape (elements, 4)
        Nodes of each element; seen from the fourth, the first three are anticlockwise.
    material : Material
        The solid.

    Returns
    -------
    mass : array, shape (elements, 4, 4)
        In kg, the integrals of rho N_i N_j.
    stiffness : array, shape (elements, 4, 3, 4, 3)
        In N/m, by node and direction.

    Raises
    ------
    DeclarationError
        If an element is inverted or flat.
    """
    volumes = np.linalg.det(_edges(points, cells)) / 6
    if (volumes <= 0).any():
        wrong = cells[np.flatnonzero(volumes <= 0)[0]].tolist()
        raise DeclarationError(f"the tetra of nodes {wrong} is inverted: its Jacobian determinant is not positive")
    slopes = gradients(points, cells)
    mass = material.rho * volumes[:, None, None] * (np.ones((4, 4)) + np.eye(4)) / 20
    first, second = material.lame
    weighted = volumes[:, None, None] * slopes
    products = np.einsum("eia,ejb->eiajb", weighted, slopes)
    along = np.einsum("eic,ejc->eij", weighted, slopes)
    stiffness = first * products + second * products.transpose(0, 1, 4, 3, 2)
    stiffness += second * along[:, :, None, :, None] * np.eye(3)[:, None, :]
    return mass, stiffness
