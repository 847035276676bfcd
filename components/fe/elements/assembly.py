"""Assembly of the mass and stiffness matrices of a mesh."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.elements import brick, quadratic, tetrahedron
from components.fe.elements.material import Material
from components.fe.nodes import Nodes

NODES = {"hexahedron": 8, "hexahedron20": 20, "tetra10": 10, "tetra": 4}
OWN = {"hexahedron": brick.matrices, "tetra": tetrahedron.matrices}
# Elements integrated in one batch, to bound the memory: a brick takes 9 kB, a batch 180 MB.
BATCH = 20_000
# Element types of surfaces, lines and points, which are ignored.
FLAT = ("vertex", "line", "triangle", "quad")


def assemble(
    points: Any, cells: Mapping[str, Any] | Iterable[tuple[str, Any]], *, E: float, nu: float, rho: float
) -> tuple[Any, Any, Nodes]:
    """Assemble the mass and stiffness matrices of a homogeneous solid.

    Parameters
    ----------
    points : array, shape (N, 3)
        Positions of the nodes in m.
    cells : mapping or pairs from str to array, shape (elements, nodes of one)
        Nodes of the elements by meshio's names of their types: "hexahedron" (with incompatible modes), "hexahedron20"
        and "tetra10" (isoparametric, so edges may be curved), and "tetra" (far too stiff in bending). Surfaces, lines
        and points are ignored.
    E, nu, rho : float
        Young's modulus in Pa, Poisson's ratio, density in kg/m3.

    Returns
    -------
    M, K : sparse matrix, shape (3 N, 3 N)
        Mass in kg and stiffness in N/m, equations in the order x, y, z of each node.
    nodes : Nodes, shape (N, 3)
        The points, with the elements as `nodes.cells`.

    Raises
    ------
    DeclarationError
        If an element type is unknown, an element is inverted or refers to a node that does not exist, or a node belongs
        to no element.
    """
    from scipy.sparse import bmat, csr_array, kron

    material = Material(E, nu, rho)
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise DeclarationError(f"points of a mesh must be finite and of shape (N, 3); these have shape {points.shape}")
    count = len(points)
    mass, blocks = csr_array((count, count)), np.full((3, 3), csr_array((count, count)), dtype=object)
    used = np.zeros(count, dtype=bool)
    solids = _solids(cells, count)
    for kind, members in solids:
        used[members] = True
        parts = _own if kind in OWN else quadratic.matrices
        own, stiffness = parts(kind, points, members, material)
        mass, blocks = mass + own, blocks + stiffness
    if not used.all():
        lone = np.flatnonzero(~used)
        raise DeclarationError(
            f"{len(lone)} nodes belong to no solid element, the first are {lone[:5].tolist()}; remove them"
        )
    order = np.arange(3 * count).reshape(3, count).T.ravel()  # reorder from x, y, z of all nodes to x, y, z of each
    K = csr_array(bmat(blocks.tolist(), format="csr"))[order][:, order]
    return csr_array(kron(mass, np.eye(3), format="csr")), (K + K.T) / 2, Nodes(points, cells=_joined(solids))


def _solids(cells: Any, count: int) -> list[tuple[str, np.ndarray]]:
    found = []
    for kind, members in cells.items() if isinstance(cells, Mapping) else cells:
        if kind.startswith(FLAT):
            continue
        if kind not in NODES:
            raise DeclarationError(f"unknown element type {kind!r}; known types are {', '.join(NODES)}")
        members = np.asarray(members)
        if members.ndim != 2 or members.shape[1] != NODES[kind] or not np.issubdtype(members.dtype, np.integer):
            raise DeclarationError(
                f"cells of type {kind} need {NODES[kind]} integer node indices each; these have shape {members.shape}"
            )
        if members.size and (members.min() < 0 or members.max() >= count):
            raise DeclarationError(f"a {kind} refers to a node outside 0 to {count - 1}")
        if len(members):
            found.append((kind, members))
    if not found:
        raise DeclarationError(f"the mesh has no solid elements ({', '.join(NODES)})")
    return found


def _joined(solids: list[tuple[str, np.ndarray]]) -> dict[str, np.ndarray]:
    return {kind: np.concatenate([m for other, m in solids if other == kind]) for kind, _ in solids}


def _own(kind: str, points: np.ndarray, cells: np.ndarray, material: Material) -> tuple[Any, np.ndarray]:
    from scipy.sparse import csr_array

    parts = [OWN[kind](points, some, material) for some in np.array_split(cells, len(cells) // BATCH + 1)]
    mass, stiffness = (np.concatenate(both) for both in zip(*parts, strict=True))
    count = cells.shape[1]
    rows, columns = np.repeat(cells, count, axis=1).ravel(), np.tile(cells, count).ravel()

    def sparse(values: np.ndarray) -> Any:
        return csr_array((values.ravel(), (rows, columns)), shape=(len(points), len(points)))

    blocks = np.empty((3, 3), dtype=object)
    for a in range(3):
        for b in range(3):
            blocks[a, b] = sparse(stiffness[:, :, a, :, b])
    return sparse(mass), blocks
