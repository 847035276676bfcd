"""Tetrahedra of 4 nodes: constant strain."""

from __future__ import annotations

import numpy as np

from acausal import DeclarationError
from components.fe.elements.material import Material

_SLOPES = np.vstack([-np.ones(3), np.eye(3)])  # of the shape functions in the element's own coordinates


def gradients(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Return gradients of the shape functions in 1/m, shape (elements, 4, 3)."""
    return np.einsum("ix,exa->eia", _SLOPES, np.linalg.inv(_edges(points, cells)))


def _edges(points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Edges from the first corner as columns: the Jacobian, shape (elements, 3, 3)."""
    return np.swapaxes(points[cells[:, 1:]] - points[cells[:, :1]], 1, 2)


def matrices(points: np.ndarray, cells: np.ndarray, material: Material) -> tuple[np.ndarray, np.ndarray]:
    """Masses of pairs of nodes and stiffness of each element.

    Parameters
    ----------
    points : array, shape (N, 3)
        Places of the nodes in m.
    cells : array, shape (elements, 4)
        Nodes of each element, the fourth where the first three turn anticlockwise seen from it.
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
        If an element is turned inside out or flat.
    """
    volumes = np.linalg.det(_edges(points, cells)) / 6
    if (volumes <= 0).any():
        wrong = cells[np.flatnonzero(volumes <= 0)[0]].tolist()
        raise DeclarationError(f"the tetra of nodes {wrong} is turned inside out or folded")
    slopes = gradients(points, cells)
    mass = material.rho * volumes[:, None, None] * (np.ones((4, 4)) + np.eye(4)) / 20
    first, second = material.lame
    weighted = volumes[:, None, None] * slopes
    products = np.einsum("eia,ejb->eiajb", weighted, slopes)
    along = np.einsum("eic,ejc->eij", weighted, slopes)
    stiffness = first * products + second * products.transpose(0, 1, 4, 3, 2)
    stiffness += second * along[:, :, None, :, None] * np.eye(3)[:, None, :]
    return mass, stiffness
