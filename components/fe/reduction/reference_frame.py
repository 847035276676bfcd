"""Reference frames: constraints on the deformation of a body that define its rigid motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.node_frames import ON_A_LINE, Frame
from components.fe.reduction.solid import Solid

MEAN_AXIS = "mean-axis"
DIRECTIONS = "xyz"


@dataclass(frozen=True)
class Reference:
    """Reference frame of a body; its axes are those of the node coordinates.

    Parameters
    ----------
    origin : array, shape (3,)
        Position in m.
    held : array of int
        Equations with displacement 0.
    rows : array, shape (k, 3 N)
        Further constraints: rows @ u = 0.
    names : tuple of str
        Interfaces that coincide with the reference frame or are fixed to it.
    """

    origin: Array
    held: Array
    rows: Array
    names: tuple[str, ...] = ()


def reference(hold: Any, frames: list[Frame], body: Solid) -> Reference:
    """Return the reference frame defined by `hold` of `reduce_body`.

    Raises
    ------
    DeclarationError
        If `hold` refers to unknown frames or nodes, or leaves rigid-body motions free.
    """
    if isinstance(hold, str) and hold == MEAN_AXIS:
        return Reference(body.centre, np.zeros(0, dtype=int), body.weigh(body.rigid).T / body.total)
    if isinstance(hold, str | Mapping):
        found = _of_frames(hold if isinstance(hold, Mapping) else {hold: DIRECTIONS}, frames, body)
        return _completed(found, frames if isinstance(hold, str) else [], body)
    nodes = np.asarray(hold)
    if nodes.shape != (3,) or not np.issubdtype(nodes.dtype, np.integer):
        raise DeclarationError(
            f'hold must be a frame, "mean-axis", three nodes (i, j, k), or directions by frames or nodes such as '
            f'{{"hinge": "xyz", "tip": "z"}}, not {hold!r}'
        )
    return _of_three([_node(k, body) for k in nodes.tolist()], body)


def _node(k: Any, body: Solid) -> int:
    if isinstance(k, bool) or not isinstance(k, int | np.integer) or not 0 <= k < len(body.nodes):
        raise DeclarationError(f"hold refers to node {k!r}, but nodes are numbered 0 to {len(body.nodes) - 1}")
    if body.empty[k]:
        raise DeclarationError(f"node {k} of hold has no stiffness")
    return int(k)


def _of_three(nodes: list[int], body: Solid) -> Reference:
    """Origin at node i, x axis through node j, node k in the x-y plane (Vlasenko and Kasper 2008, (99) to (103)).

    The constraints are theirs; the axes are those of the coordinates, which differ from theirs by a constant rotation.
    """
    i, j, k = nodes
    first, second = body.nodes[j] - body.nodes[i], body.nodes[k] - body.nodes[i]
    normal = np.cross(first, second)
    extent = max(np.linalg.norm(first), np.linalg.norm(second))
    if np.linalg.norm(normal) <= ON_A_LINE * extent * max(np.linalg.norm(first), ON_A_LINE * extent):
        raise DeclarationError(
            f"the nodes {i}, {j}, {k} of the reference frame are collinear; they must form a triangle"
        )
    x, z = first / np.linalg.norm(first), normal / np.linalg.norm(normal)
    rows = np.zeros((6, 3 * len(body.nodes)))
    rows[:3, 3 * i : 3 * i + 3] = np.eye(3)
    for row, (node, direction) in zip(rows[3:], ((j, np.cross(z, x)), (j, z), (k, z)), strict=True):
        row[3 * node : 3 * node + 3] = direction
    return Reference(body.nodes[i], np.zeros(0, dtype=int), rows)


def _of_frames(hold: Mapping[Any, Any], frames: list[Frame], body: Solid) -> Reference:
    """Fix nodes of frames, or their averages, in some directions."""
    known = {frame.name: frame for frame in frames}
    held, rows, origin = [], [], None
    for name, letters in hold.items():
        if not isinstance(letters, str) or not letters or set(letters) - set(DIRECTIONS):
            raise DeclarationError(f'the directions of {name!r} in hold must be letters of "xyz", not {letters!r}')
        axes = np.array([DIRECTIONS.index(letter) for letter in dict.fromkeys(letters)])
        if isinstance(name, str):
            if name not in known:
                raise DeclarationError(
                    f'hold refers to {name!r}, but the frames are {", ".join(known) or "none"}, or "mean-axis"'
                )
            frame = known[name]
            # A rigid frame is fixed at its position in some directions, or at every node in all of them.
            nodes, average = frame.nodes, frame.kind == "average" or (frame.kind == "rigid" and len(axes) < 3)
        else:
            frame, nodes, average = None, np.array([_node(name, body)]), False
        if frame and average:
            rows.append(spread(frame, body)[axes if len(axes) < 3 else slice(None)])
        else:
            held.append((3 * nodes[:, None] + axes).ravel())
        if origin is None and len(axes) == 3:
            origin = frame.place if frame else body.nodes[nodes[0]]
    equations = np.unique(np.concatenate([*held, np.zeros(0, dtype=int)]).astype(int))
    conditions = np.vstack([*rows, np.zeros((0, 3 * len(body.nodes)))])
    if origin is None:
        origin = body.nodes[np.unique(equations // 3)].mean(axis=0) if len(equations) else body.centre
    names = tuple(f.name for f in frames if _stands(f, hold, equations))
    if not names and len(equations) + len(conditions) == 6:
        # Six fixed directions define the rigid motion without fixing an interface: treat them as constraint rows.
        units = np.zeros((len(equations), 3 * len(body.nodes)))
        units[range(len(equations)), equations] = 1.0
        conditions = np.vstack([units, conditions])
        equations = equations[:0]
    return Reference(origin, equations, conditions, names)


def _stands(frame: Frame, hold: Mapping[Any, Any], equations: Array) -> bool:
    if frame.kind == "average":
        return set(hold.get(frame.name, "")) == set(DIRECTIONS) and frame.turns
    return bool(np.isin(frame.equations, equations).all())


def spread(frame: Frame, body: Solid) -> Array:
    """Return the degrees of freedom of a frame as rows over all equations."""
    rows = np.zeros((len(frame.freedoms), 3 * len(body.nodes)))
    rows[:, frame.equations] = frame.freedoms
    return rows


def _completed(found: Reference, frames: list[Frame], body: Solid) -> Reference:
    """Fix the rotation about collinear nodes by the frame farthest from their line."""
    free = free_motions(found, body)
    if free.shape[1] == 0:
        return found
    moved = [spread(frame, body)[:3] for frame in frames] if free.shape[1] == 1 else []
    motions = [(rows, rows @ body.rigid @ free[:, 0]) for rows in moved]
    rows, motion = max(motions, key=lambda entry: np.linalg.norm(entry[1]), default=(None, np.zeros(3)))
    far = np.linalg.norm(motion)
    if rows is not None and far > ON_A_LINE:
        return Reference(found.origin, found.held, np.vstack([found.rows, motion / far @ rows]), found.names)
    raise DeclarationError(
        f"hold leaves {free.shape[1]} of the six rigid-body motions free: too few nodes, or collinear ones. Use a frame of "
        "more nodes, add a frame off the line, or, in Python, hold more directions, such as "
        '{"hinge": "xyz", "tip": "z"}'
    )


def free_motions(found: Reference, body: Solid) -> Array:
    """Return the combinations of `body.rigid` that a reference frame leaves free, shape (6, d)."""
    conditions = np.vstack([body.rigid[found.held], found.rows @ body.rigid])
    return null_space(conditions)


def null_space(rows: Array) -> Array:
    """Return an orthonormal basis of the null space of rows, with the tolerance of collinear nodes."""
    _, values, directions = np.linalg.svd(np.linalg.qr(np.vstack([rows, np.zeros((rows.shape[1],) * 2)]), mode="r"))
    return directions[values <= ON_A_LINE * max(values.max(), np.finfo(float).tiny)].T
