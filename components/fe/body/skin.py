"""What a body of finite elements looks like: the skin of its mesh, which deforms with its modes."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import geometry
from components.fe.arrays import Array
from components.fe.elements.faces import FACES
from components.fe.reduction.nodal_field import NodalField
from components.fe.reduction.reduced_body import ReducedBody


def skin(nodal: NodalField) -> tuple[Array, Array]:
    """Return the nodes of the skin of a mesh, and its triangles between them, outward anticlockwise.

    Faces of one element alone are the skin. It goes through the corners: bent edges of quadratic elements are straight.

    Returns
    -------
    nodes : array of int, shape (n,)
        Rows of the nodes, increasing.
    triangles : array of int, shape (m, 3)
        Places in `nodes`; m is 0 where no solid elements are known.
    """
    found = [np.zeros((0, 4), dtype=np.int64)]
    for kind, cells in nodal.cells.items():
        if kind in FACES:
            faces = FACES[kind]
            corners = np.asarray(cells)[:, : 1 + max(max(face) for face in faces)]
            found.append(_outward(corners[:, faces].reshape(-1, 4), corners.repeat(len(faces), axis=0), nodal.nodes))
    every = np.concatenate(found)
    # Faces are one if they have the same corners, of which a triangle has one twice, in any place.
    ordered = np.sort(every, axis=1)
    ordered[:, 1:][ordered[:, 1:] == ordered[:, :-1]] = -1
    _, first, times = np.unique(np.sort(ordered, axis=1), axis=0, return_index=True, return_counts=True)
    outside = every[first[times == 1]]
    triangles = np.concatenate([outside[:, [0, 1, 2]], outside[:, [0, 2, 3]]])
    distinct = np.diff(np.sort(triangles, axis=1), axis=1).all(axis=1)
    nodes, places = np.unique(triangles[distinct], return_inverse=True)
    return nodes, places.reshape(-1, 3)


def mesh(nodal: NodalField | None, at: geometry.Pose, q: Any) -> geometry.Mesh | None:
    """Return the skin of a body with coordinates q of its first modes; None if it knows no solid elements."""
    if nodal is None or not FACES.keys() & nodal.cells.keys():
        return None
    nodes, triangles = skin(nodal)
    if not q.shape[0]:
        return geometry.Mesh(at, nodal.nodes[nodes], triangles)
    return geometry.Mesh(at, nodal.nodes[nodes], triangles, nodal.modes[nodes, :, : q.shape[0]].transpose(2, 0, 1), q)


def box_of_inertia(body: ReducedBody, at: geometry.Pose) -> geometry.Box:
    """Return the homogeneous box with the mass and moments of inertia of an undeformed body: m l^2 / 12 along its edges."""
    centre = body.first_moment / body.mass
    squares, axes = np.linalg.eigh(body.second_moment / body.mass - np.outer(centre, centre))
    return geometry.Box(at, centre, np.sqrt(12 * np.maximum(squares, 0)), axes.T)


def _outward(faces: Array, corners: Array, places: Array) -> Array:
    """Turn faces round that are seen clockwise from outside their element, whose corners are given for each."""
    a, b, c, d = (places[faces[:, k]] for k in range(4))
    normal = np.cross(c - a, d - b)
    inward = np.einsum("ij,ij->i", normal, (a + b + c + d) / 4 - places[corners].mean(axis=1)) < 0
    return np.where(inward[:, None], faces[:, ::-1], faces)
