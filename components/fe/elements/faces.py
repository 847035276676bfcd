"""Element faces spanned by nodes, and the area weights of these nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product

import numpy as np

from components.fe.arrays import Array
from components.fe.elements.quadratic import EDGES as QUADRATIC

# Faces by their corners, in either orientation; the last corner of a triangle stands twice. Mid-edge nodes follow the
# corners.
HEXAHEDRON = ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
TETRAHEDRON = ((0, 1, 2, 2), (0, 1, 3, 3), (1, 2, 3, 3), (2, 0, 3, 3))
WEDGE = ((0, 1, 2, 2), (3, 4, 5, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
FACES = {
    "tetra": TETRAHEDRON,
    "tetra10": TETRAHEDRON,
    "wedge": WEDGE,
    "wedge15": WEDGE,
    "hexahedron": HEXAHEDRON,
    "hexahedron20": HEXAHEDRON,
}
# Edges by their two corners, in the order of the mid-edge nodes.
EDGES = {**QUADRATIC, "wedge15": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]}
# Gauss points of a square of side 1, exact to degree 5 in each direction.
_LINE = ((0.5 - np.sqrt(0.15), 5 / 18), (0.5, 8 / 18), (0.5 + np.sqrt(0.15), 5 / 18))


def area_weights(nodes: Array, places: Array, cells: Mapping[str, Array]) -> Array | None:
    """Return the integrals of the nodes' shape functions over the faces that they span, in m2.

    The mean with these weights is the mean over the faces, independent of local mesh refinement.

    Parameters
    ----------
    nodes : array of int, shape (k,)
        Rows of the nodes.
    places : array, shape (N, 3)
        Positions of all nodes in m.
    cells : mapping from str to array
        Elements by meshio's names of their types.

    Returns
    -------
    array, shape (k,), or None
        None if a node is on no face of the set. Interior faces count only if the outer faces do not contain all nodes.
    """
    found = list(_spanned(nodes, len(places), cells))
    for outside in (True, False):
        weights, covered = np.zeros(len(places)), np.zeros(len(places), dtype=bool)
        for faces, times in found:
            some = faces[times == 1] if outside else faces
            covered[some] = True
            np.add.at(weights, some, _integrals(places[some]))
        if covered[nodes].all():
            return weights[nodes]
    return None


def _spanned(nodes: Array, count: int, cells: Mapping[str, Array]) -> Iterator[tuple[Array, Array]]:
    """Yield the faces whose nodes are all in the set, corners first, and the number of elements that share each."""
    among = np.zeros(count, dtype=bool)
    among[nodes] = True
    found: dict[int, list[Array]] = {}
    for kind, cell in cells.items():
        members, edges = np.asarray(cell), [set(edge) for edge in EDGES.get(kind, ())]
        first = members.shape[1] - len(edges)
        edges = (
            edges if among[members[:, first:]].any() else []
        )  # without mid-edge nodes, the set contains corners only
        for face in FACES.get(kind, ()):
            corners = list(dict.fromkeys(face))
            pairs = zip(corners, corners[1:] + corners[:1], strict=True)
            own = members[:, corners + [first + edges.index({*pair}) for pair in pairs if edges]]
            found.setdefault(own.shape[1], []).append(own[among[own].all(axis=1)])
    for parts in found.values():
        every = np.concatenate(parts)
        _, first, times = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
        yield every[first], times


def _integrals(places: Array) -> Array:
    """Return the integrals of the shape functions over faces with nodes at `places`, shape (faces, nodes, 3)."""
    count = places.shape[1]
    triangle = count in (3, 6)
    found = np.zeros(places.shape[:2])
    for (u, wide), (v, high) in product(_LINE, _LINE):
        at, weight = ((u, v * (1 - u)), wide * high * (1 - u)) if triangle else ((u, v), wide * high)
        values, slopes = _shapes(count, *at)
        first, second = np.einsum("id,fix->dfx", slopes, places)
        found += weight * np.linalg.norm(np.cross(first, second), axis=1)[:, None] * values
    return found


def _shapes(count: int, x: float, y: float) -> tuple[Array, Array]:
    """Return the shape functions at a point of the unit triangle or square, and their derivatives, shape (nodes, 2).

    Each quadratic corner function is the linear one less half of the functions of its two mid-edge nodes.
    """
    if count in (3, 6):
        L, dL = np.array([1 - x - y, x, y]), np.array([[-1.0, -1], [1, 0], [0, 1]])
    else:
        a, b = np.array([1 - x, x, x, 1 - x]), np.array([1 - y, 1 - y, y, y])
        da, db = np.array([-1.0, 1, 1, -1]), np.array([-1.0, -1, 1, 1])
        L, dL = a * b, np.stack([da * b, a * db], axis=1)
    if count in (3, 4):
        return L, dL
    after = np.roll(L, -1), np.roll(dL, -1, axis=0)
    if count == 6:
        edge = 4 * L * after[0]
        slopes = 4 * (dL * after[0][:, None] + L[:, None] * after[1])
    else:  # 4 x (1 - x) along the edge, linear across it
        along = np.array([x, y, x, y])
        which = np.array([0, 1, 0, 1])
        across, other = np.array([1 - y, x, y, 1 - x]), np.array([-1.0, 1, 1, -1])
        edge = 4 * along * (1 - along) * across
        slopes = np.zeros((4, 2))
        slopes[range(4), which] = 4 * (1 - 2 * along) * across
        slopes[range(4), 1 - which] = 4 * along * (1 - along) * other
    corner = L - (edge + np.roll(edge, 1)) / 2
    return np.concatenate([corner, edge]), np.vstack([dL - (slopes + np.roll(slopes, 1, axis=0)) / 2, slopes])
