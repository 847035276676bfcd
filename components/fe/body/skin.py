"""Shape of an FE body in pictures: the surface of its mesh, deformed by its modes."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import geometry
from components.fe.arrays import Array
from components.fe.elements.faces import FACES
from components.fe.reduction.nodal_field import NodalField
from components.fe.reduction.reduced_body import ReducedBody


def skin(nodal: NodalField) -> tuple[Array, Array]:
    """Return the nodes and triangles of the surface of a mesh, anticlockwise seen from outside.

    The surface consists of the faces that belong to one element only. It connects corners: curved edges become
    straight.

    Returns
    -------
    nodes : array of int, shape (n,)
        Rows of the nodes, ascending.
    triangles : array of int, shape (m, 3)
        Indices into `nodes`; m is 0 if no solid elements are known.
    """
    found = [np.zeros((0, 4), dtype=np.int64)]
    for kind, cells in nodal.cells.items():
        if kind in FACES:
            faces = FACES[kind]
            corners = np.asarray(cells)[:, : 1 + max(max(face) for face in faces)]
            found.append(_outward(corners[:, faces].reshape(-1, 4), corners.repeat(len(faces), axis=0), nodal.nodes))
    every = np.concatenate(found)
    # Equal faces have the same set of corners; the repeated corner of a triangle may differ.
    ordered = np.sort(every, axis=1)
    ordered[:, 1:][ordered[:, 1:] == ordered[:, :-1]] = -1
    _, first, times = np.unique(np.sort(ordered, axis=1), axis=0, return_index=True, return_counts=True)
    outside = every[first[times == 1]]
    triangles = np.concatenate([outside[:, [0, 1, 2]], outside[:, [0, 2, 3]]])
    distinct = np.diff(np.sort(triangles, axis=1), axis=1).all(axis=1)
    nodes, places = np.unique(triangles[distinct], return_inverse=True)
    return nodes, places.reshape(-1, 3)


def mesh(nodal: NodalField | None, at: geometry.Pose, q: Any) -> geometry.Mesh | None:
    """Return the surface of a body deformed by its modal coordinates q; None if no solid elements are known."""
    if nodal is None or not FACES.keys() & nodal.cells.keys():
        return None
    nodes, triangles = skin(nodal)
    if not q.shape[0]:
        return geometry.Mesh(at, nodal.nodes[nodes], triangles)
    return geometry.Mesh(at, nodal.nodes[nodes], triangles, nodal.modes[nodes, :, : q.shape[0]].transpose(2, 0, 1), q)


def box_of_inertia(body: ReducedBody, at: geometry.Pose) -> geometry.Box:
    """Return the homogeneous box with the mass and moments of inertia of the undeformed body."""
    centre = body.first_moment / body.mass
    squares, axes = np.linalg.eigh(body.second_moment / body.mass - np.outer(centre, centre))
    return geometry.Box(at, centre, np.sqrt(12 * np.maximum(squares, 0)), axes.T)


def _outward(faces: Array, corners: Array, places: Array) -> Array:
    """Reverse the faces that are clockwise seen from outside their element, given by its corners."""
    a, b, c, d = (places[faces[:, k]] for k in range(4))
    normal = np.cross(c - a, d - b)
    inward = np.einsum("ij,ij->i", normal, (a + b + c + d) / 4 - places[corners].mean(axis=1)) < 0
    return np.where(inward[:, None], faces[:, ::-1], faces)
