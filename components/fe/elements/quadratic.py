"""Isoparametric tetrahedra with 10 and bricks with 20 nodes, assembled by scikit-fem."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.elements.material import Material

# Edges by their two corners, in the order of the mid-edge nodes of meshio, VTK and Abaqus.
EDGES = {
    "tetra10": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "hexahedron20": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
}
CORNERS = {
    "tetra10": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    "hexahedron20": np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]),
}
# Quadrature order, exact for the mass of an element with straight edges.
ORDER = {"tetra10": 4, "hexahedron20": 5}


def matrices(kind: str, points: np.ndarray, cells: np.ndarray, material: Material) -> tuple[Any, np.ndarray]:
    """Return the mass matrix and the stiffness blocks of a mesh.

    Parameters
    ----------
    kind : str
        "tetra10" or "hexahedron20".
    points : array, shape (N, 3)
        Positions of the nodes in m.
    cells : array, shape (elements, nodes of one)
        Corners, then mid-edge nodes, in the order of meshio.
    material : Material
        The solid.

    Returns
    -------
    mass : sparse matrix, shape (N, N)
        In kg, the same for each direction.
    stiffness : array of sparse matrices, shape (3, 3)
        Blocks by the two directions, each (N, N), in N/m.

    Raises
    ------
    DeclarationError
        If an element is inverted, or adjacent elements do not share their mid-edge nodes.
    """
    basis, nodes = _basis(kind, points, cells)
    from skfem import BilinearForm

    volumes = basis.mapping.detDF(basis.X)
    if (volumes <= 0).any():
        wrong = int(np.flatnonzero((volumes <= 0).any(axis=1))[0])
        raise DeclarationError(
            f"the {kind} of nodes {cells[wrong].tolist()} is inverted: its Jacobian determinant is not positive"
        )

    def assembled(form: Any) -> Any:
        local = BilinearForm(form).assemble(basis).tocoo()
        return _sparse(local.data, nodes[local.row], nodes[local.col], len(points))

    mass = assembled(lambda u, v, w: material.rho * u * v)
    gradients = np.empty((3, 3), dtype=object)
    for a in range(3):
        for b in range(a, 3):
            gradients[a, b] = assembled(lambda u, v, w, a=a, b=b: v.grad[a] * u.grad[b])
            gradients[b, a] = gradients[a, b].T
    first, second = material.lame
    trace = gradients[0, 0] + gradients[1, 1] + gradients[2, 2]
    stiffness = first * gradients + second * gradients.T
    for a in range(3):
        stiffness[a, a] = stiffness[a, a] + second * trace
    return mass, stiffness


def _sparse(data: Any, rows: Any, columns: Any, count: int) -> Any:
    from scipy.sparse import csr_array

    return csr_array((data, (rows, columns)), shape=(count, count))


def _basis(kind: str, points: np.ndarray, cells: np.ndarray) -> tuple[Any, np.ndarray]:
    """Return a scikit-fem basis with isoparametric geometry, and the node of each of its degrees of freedom."""
    from skfem import Basis, ElementHexS2, ElementTetP2, MeshHex1, MeshTet1
    from skfem.mapping import MappingIsoparametric

    element, plain = (ElementTetP2(), MeshTet1) if kind == "tetra10" else (ElementHexS2(), MeshHex1)
    corners = CORNERS[kind]
    places = np.vstack([corners, [corners[list(edge)].mean(axis=0) for edge in EDGES[kind]]])
    # Index in a meshio cell of each of scikit-fem's nodes.
    positions = [int(np.flatnonzero((places == place).all(axis=1))[0]) for place in np.asarray(element.doflocs)]
    used, vertices = np.unique(cells[:, positions[: len(corners)]], return_inverse=True)
    mesh = plain(points[used].T.copy(), vertices.reshape(len(cells), -1).T.copy(), sort_t=False)
    freedoms = Basis(mesh, element, intorder=1).dofs.element_dofs
    nodes = np.zeros(freedoms.max() + 1, dtype=int)
    nodes[freedoms] = cells[:, positions].T
    torn = (nodes[freedoms] != cells[:, positions].T).any(axis=0)
    if torn.any():
        wrong = int(np.flatnonzero(torn)[0])
        raise DeclarationError(
            f"element {wrong} shares an edge with another element, but not its mid-edge node: {cells[wrong].tolist()}"
        )
    # The attributes that the mapping reads: scikit-fem has no mesh class for hexahedra with 20 nodes.
    curved: Any = SimpleNamespace(doflocs=points[nodes].T, dofs=SimpleNamespace(element_dofs=freedoms), dim=lambda: 3)
    basis = Basis(mesh, element, mapping=MappingIsoparametric(curved, element), intorder=ORDER[kind])
    return basis, nodes
