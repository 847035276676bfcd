"""Stress recovery: stresses at the Barlow points of elements, extrapolated to their nodes."""

from __future__ import annotations

from itertools import product

import numpy as np

from acausal import DeclarationError
from components.fe.elements import brick, quadratic, tetrahedron
from components.fe.elements.material import Material

# Order of the stress components, that of most FE programs.
COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
_CUBE = np.array(list(product((-1.0, 1.0), repeat=3))) / np.sqrt(3)
_A, _B = (5 + 3 * np.sqrt(5)) / 20, (5 - np.sqrt(5)) / 20
# Barlow points, where stresses converge as fast as displacements: Gauss points of the stiffness integration or of one
# order less, in reference coordinates.
POINTS = {
    "hexahedron": _CUBE,
    "hexahedron20": (1 + _CUBE) / 2,
    "tetra10": np.array([[_B, _B, _B], [_A, _B, _B], [_B, _A, _B], [_B, _B, _A]]),
    "tetra": np.full((1, 3), 1 / 4),
}


def operator(kind: str, points: np.ndarray, cells: np.ndarray, material: Material) -> np.ndarray:
    """Return the matrices that map nodal displacements in m to stresses in Pa at the `POINTS` of each element.

    Parameters
    ----------
    kind : str
        "hexahedron" (with incompatible modes, as in `box` and `assemble`), "hexahedron20", "tetra10" or "tetra".
    points : array, shape (N, 3)
        Positions of the nodes in m.
    cells : array, shape (elements, k)
        Nodes of each element, in the order of meshio.
    material : Material
        The solid.

    Returns
    -------
    array, shape (elements, points, 6, k, 3)
        Components in the order of `COMPONENTS`.

    Raises
    ------
    DeclarationError
        If stresses are not implemented for this element type.
    """
    if kind not in POINTS:
        raise DeclarationError(f"stresses are implemented for elements {', '.join(POINTS)}, not for {kind}")
    if kind == "hexahedron":
        bubbles = brick.incompatible(points, cells, material)
        parts = [brick.gradients(points[cells], at)[0] for at in POINTS[kind]]
        strains = [_strain(g[:, :8]) + np.einsum("esjb,ejbic->esic", _strain(g[:, 8:]), bubbles) for g in parts]
    elif kind == "tetra":
        strains = [_strain(tetrahedron.gradients(points, cells))]
    else:
        strains = [_strain(_gradients(kind, points[cells], at)) for at in POINTS[kind]]
    return np.einsum("st,eptic->epsic", _elasticity(material), np.stack(strains, axis=1))


def to_nodes(kind: str) -> np.ndarray:
    """Return the extrapolation from `POINTS` to the nodes, linear in each coordinate, shape (nodes, points)."""
    if kind == "tetra":
        return np.ones((4, 1))
    places = brick.CORNERS if kind == "hexahedron" else _places(kind)
    powers = np.array(list(product((0, 1), repeat=3))) if kind != "tetra10" else np.vstack([np.zeros(3), np.eye(3)])
    return _monomials(places, powers) @ np.linalg.inv(_monomials(POINTS[kind], powers))


def _places(kind: str) -> np.ndarray:
    corners = quadratic.CORNERS[kind].astype(float)
    return np.vstack([corners, [corners[list(edge)].mean(axis=0) for edge in quadratic.EDGES[kind]]])


def _monomials(places: np.ndarray, powers: np.ndarray) -> np.ndarray:
    return np.prod(places[:, None, :] ** powers[None], axis=2)


def _gradients(kind: str, places: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the gradients of the shape functions at a point, shape (elements, nodes, 3)."""
    slopes = _slopes(kind, at)
    jacobian = np.einsum("eia,ix->eax", places, slopes)
    return np.einsum("ix,exa->eia", slopes, np.linalg.inv(jacobian))


def _slopes(kind: str, at: np.ndarray) -> np.ndarray:
    """Return the derivatives of the shape functions, the Lagrange polynomials of the nodes."""
    every = np.array(list(product(range(3), repeat=3)))
    # Degree 2, or serendipity: at most one squared coordinate.
    few = every.sum(axis=1) <= 2 if kind == "tetra10" else (every == 2).sum(axis=1) <= 1
    powers = every[few]
    derived = [
        powers[:, [x]] * _monomials(at[None], np.maximum(powers - np.eye(3, dtype=int)[x], 0)).T for x in range(3)
    ]
    return np.linalg.inv(_monomials(_places(kind), powers)).T @ np.hstack(derived)


def _strain(gradients: np.ndarray) -> np.ndarray:
    """Return the strain-displacement matrices with engineering shear strains, shape (elements, 6, nodes, 3)."""
    found = np.zeros((len(gradients), 6, gradients.shape[1], 3))
    for row, (a, b) in enumerate(_PAIRS):
        found[:, row, :, a] = gradients[:, :, b]
        found[:, row, :, b] = gradients[:, :, a]
    return found


def _elasticity(material: Material) -> np.ndarray:
    first, second = material.lame
    matrix = np.diag([2 * second] * 3 + [second] * 3)
    matrix[:3, :3] += first
    return matrix
