"""Stresses of a mesh from displacements of its nodes: at points inside of the elements, and from these at the nodes."""

from __future__ import annotations

from itertools import product

import numpy as np

from acausal import DeclarationError
from components.fe.elements import brick, quadratic, tetrahedron
from components.fe.elements.material import Material

# Stresses in the order of most programs.
COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
_CUBE = np.array(list(product((-1.0, 1.0), repeat=3))) / np.sqrt(3)
_A, _B = (5 + 3 * np.sqrt(5)) / 20, (5 - np.sqrt(5)) / 20
# Barlow points: there stresses of the displacements are as good as the displacements; Gauss points of the stiffness or of
# one order less, in the elements' own coordinates.
POINTS = {
    "hexahedron": _CUBE,
    "hexahedron20": (1 + _CUBE) / 2,
    "tetra10": np.array([[_B, _B, _B], [_A, _B, _B], [_B, _A, _B], [_B, _B, _A]]),
    "tetra": np.full((1, 3), 1 / 4),
}


def operator(kind: str, points: np.ndarray, cells: np.ndarray, material: Material) -> np.ndarray:
    """Stresses in Pa at the `POINTS` of each element by displacements of its nodes in m.

    Parameters
    ----------
    kind : str
        "hexahedron" (with incompatible modes, as `box` and `assemble` make it), "hexahedron20", "tetra10" or "tetra".
    points : array, shape (N, 3)
        Places of the nodes in m.
    cells : array, shape (elements, k)
        Nodes of each element, in the order of meshio.
    material : Material
        The solid.

    Returns
    -------
    array, shape (elements, points of one, 6, k, 3)
        In the order of `COMPONENTS`.

    Raises
    ------
    DeclarationError
        If stresses of this kind of element are not known.
    """
    if kind not in POINTS:
        raise DeclarationError(f"stresses are known of elements {', '.join(POINTS)}, not of {kind}")
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
    """Values at the nodes of an element by values at its `POINTS`, shape (nodes, points): linear in each coordinate."""
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
    """Gradients of the shape functions at a point, shape (elements, nodes, 3)."""
    slopes = _slopes(kind, at)
    jacobian = np.einsum("eia,ix->eax", places, slopes)
    return np.einsum("ix,exa->eia", slopes, np.linalg.inv(jacobian))


def _slopes(kind: str, at: np.ndarray) -> np.ndarray:
    """Derivatives of the shape functions: polynomials that are 1 at one node and 0 at the others."""
    every = np.array(list(product(range(3), repeat=3)))
    # Of degree 2, or serendipity: one square at most.
    few = every.sum(axis=1) <= 2 if kind == "tetra10" else (every == 2).sum(axis=1) <= 1
    powers = every[few]
    derived = [
        powers[:, [x]] * _monomials(at[None], np.maximum(powers - np.eye(3, dtype=int)[x], 0)).T for x in range(3)
    ]
    return np.linalg.inv(_monomials(_places(kind), powers)).T @ np.hstack(derived)


def _strain(gradients: np.ndarray) -> np.ndarray:
    """Strains, shear as angles, by displacements: shape (elements, 6, nodes, 3)."""
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
