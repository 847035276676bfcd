"""Structured mesh of a box."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.elements.assembly import assemble
from components.fe.elements.quadratic import CORNERS, EDGES
from components.fe.nodes import Nodes

KINDS = {"hex8": "hexahedron", "hex20": "hexahedron20", "tet10": "tetra10"}
# Kuhn subdivision of a box into six tetrahedra around its diagonal: paths along the axes, one for each order of the
# axes. Adjacent boxes share the diagonals of their common faces.
ORDERS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2))


def mesh(size: Any, counts: Any, element: str) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Return the points and elements of a box in the form of meshio and `assemble`; see `box`.

    Returns
    -------
    points : array, shape (N, 3)
        In m.
    cells : dict from str to array
        Nodes of the elements by meshio's name of their type.
    """
    if element not in KINDS:
        raise DeclarationError(f"element must be one of {', '.join(KINDS)}, not {element!r}")
    lengths, parts = np.asarray(size, dtype=float), np.asarray(counts)
    if lengths.shape != (3,) or not (np.isfinite(lengths) & (lengths > 0)).all():
        raise DeclarationError(f"size must be three positive lengths in m, not {size!r}")
    if parts.shape != (3,) or not np.issubdtype(parts.dtype, np.integer) or (parts < 1).any():
        raise DeclarationError(f"counts must be three positive integers, not {counts!r}")
    fine = 1 if element == "hex8" else 2  # lattice steps per element edge
    lattice = fine * parts + 1
    ranges = [np.arange(n) for n in parts]
    first = fine * np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    places = _places(element, fine)
    every = first + places.reshape(1, -1, 3)
    cells = np.ravel_multi_index(tuple(np.moveaxis(every, -1, 0)), tuple(lattice))
    used, cells = np.unique(cells, return_inverse=True)
    steps = np.stack(np.unravel_index(used, tuple(lattice)), axis=1)
    return steps * (lengths / (lattice - 1)), {KINDS[element]: cells.reshape(-1, places.shape[1])}


def _places(element: str, fine: int) -> np.ndarray:
    """Lattice indices of the element nodes within one box, shape (elements, nodes, 3)."""
    kind = "hexahedron20" if element != "tet10" else "tetra10"
    if element != "tet10":
        corners = [CORNERS[kind]]
    else:
        corners = [np.array([np.isin(range(3), order[:k]) for k in range(4)], dtype=int) for order in ORDERS]
        # An odd permutation reverses the orientation.
        corners = [c if k < 3 else c[[1, 0, 2, 3]] for k, c in enumerate(corners)]
    edges = EDGES[kind] if element != "hex8" else []
    return np.array([[*(fine * c), *(c[i] + c[j] for i, j in edges)] for c in corners])


def box(size: Any, counts: Any, element: str, *, E: float, nu: float, rho: float) -> tuple[Any, Any, Nodes]:
    """Assemble the mass and stiffness matrices of a box with one corner at the origin and edges along the axes.

    Parameters
    ----------
    size : array_like, shape (3,)
        Lengths of the edges along x, y, z in m.
    counts : array_like of int, shape (3,)
        Elements along x, y, z.
    element : str
        "hex8" (8 nodes, incompatible modes), "hex20" (20 nodes), or "tet10" (six tetrahedra of 10 nodes in each cell).
    E, nu, rho : float
        Young's modulus in Pa, Poisson's ratio, density in kg/m3.

    Returns
    -------
    M, K : sparse matrix, shape (3 N, 3 N)
        Mass in kg and stiffness in N/m, equations in the order x, y, z of each node.
    nodes : array, shape (N, 3)
        Positions of the nodes in m; z runs fastest, then y, then x.

    Raises
    ------
    DeclarationError
        If the size, the counts, the element or the material is invalid.

    Examples
    --------
    >>> M, K, nodes = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", E=1e7, nu=0.49, rho=17333)
    >>> nodes.shape, M.shape
    ((54, 3), (162, 162))
    """
    return assemble(*mesh(size, counts, element), E=E, nu=nu, rho=rho)
