"""Modal reduction of mass and stiffness matrices."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.bases import basis as basis_of
from components.fe.reduction.inertia_invariants import ROUNDING, invariants
from components.fe.reduction.interface import Interface
from components.fe.reduction.matrix_checks import checked_solid
from components.fe.reduction.nodal_field import NodalField
from components.fe.reduction.node_frames import Frame, frames_of
from components.fe.reduction.reduced_body import ReducedBody
from components.fe.reduction.reference_frame import Reference
from components.fe.reduction.solid import Solid


def reduce_body(
    M: Any,
    K: Any,
    nodes: Any,
    *,
    frames: Mapping[str, Any],
    hold: Any = "mean-axis",
    modes: int = 10,
    basis: str = "held",
    damping: Any = 0.0,
    frequency: float | None = None,
) -> ReducedBody:
    """Reduce a free solid body to a few modes in a floating reference frame.

    Parameters
    ----------
    M, K : sparse matrix or array, shape (3 N, 3 N)
        Mass in kg and stiffness in N/m of the free body; equations in the order x, y, z of each node. M may be
        semi-definite; its 3 x 3 blocks must be multiples of the unit matrix.
    nodes : array_like, shape (N, 3)
        Positions of the nodes in m. The reference frame and frames without axes of their own have the same axes.
    frames : mapping from str to nodes
        Frames where the body is connected: a name and the indices of its nodes, counted from 0. A frame follows the
        average of its nodes, weighted by the area of the faces that they span, or equally if `nodes` has no elements.
        If the reference frame is fixed to the frame, each of its nodes is fixed. The frame is at the mean of its nodes,
        with a warning if that is off the axis of a circle through them; `frame_at(nodes, place, axes)` sets its
        position and axes. `rigid(nodes)` connects the nodes rigidly, as for welded bodies; `average(nodes, weights)`
        always averages.
    hold : str, (int, int, int) or mapping
        What the reference frame is fixed to; the modes have no displacement there:

        - a frame of `frames`. If its nodes are collinear, as at a hinge, the rotation about their line is fixed by the
          frame farthest from the line, which stays in its plane with the line;
        - "mean-axis": the modes have neither momentum nor angular momentum (Buckens); the origin is the centre of mass;
        - (i, j, k): node i is the origin, node j stays on the line from i to j, node k in the plane of the three
          (Vlasenko and Kasper 2008, equations (99) to (103));
        - directions by frames or nodes: {"hinge": "xyz", "tip": "z"} or {0: "xyz", 2: "xyz", 4: "xyz", 53: "z"}.
    modes : int
        Number of modes, including the static modes of a Craig-Bampton basis. Ignored if `frequency` is given.
    basis : str
        - "held": modes of the body with its reference frame fixed;
        - "free": modes of the free body relative to the reference frame, which is fixed to the average of a frame's
          nodes; the same as "held" for "mean-axis";
        - "craig-bampton": modes with all frames fixed, and a static mode for each degree of freedom of a frame relative
          to the reference frame (Craig and Bampton 1968): exact under slow forces on the frames.

        All are orthogonalised and ordered by their frequencies with the reference frame fixed.
    damping : float or array_like, shape (n,)
        Damping ratio of the modes.
    frequency : float, optional
        Take all modes up to this frequency in Hz (Craig-Bampton: with all frames fixed) instead of a number.

    Returns
    -------
    ReducedBody
        With nodes and nodal modes, for nodal results.

    Raises
    ------
    DeclarationError
        If matrices, nodes or frames are invalid (see `matrix_checks`), or there are fewer modes than requested.

    Examples
    --------
    >>> M, K, nodes = box((0.1, 0.015, 0.01), (8, 2, 1), "hex8", E=1e7, nu=0.49, rho=17333)
    >>> rod = reduce_body(M, K, nodes, frames={"hinge": [0, 2, 4], "tip": [50]}, hold="hinge", modes=9)
    """
    _numbers(modes, frequency)
    body = checked_solid(M, K, nodes)
    cells = getattr(nodes, "cells", {})
    found = frames_of(frames, body.nodes, body.empty, cells)
    wanted = None if frequency is not None else int(modes)
    shapes, squares, held = basis_of(basis, hold, found, body, wanted, frequency or np.inf)
    if not len(squares):
        raise DeclarationError(f"no mode is below {frequency} Hz")
    if wanted is not None and len(squares) < wanted:
        raise DeclarationError(f"the body has only {len(squares)} modes with mass, but modes={wanted}")
    shapes, squares = shapes[:, :wanted], squares[:wanted]
    free = "average" if basis == "free" else "held"
    found = [replace(frame, kind=frame.kind or (free if frame.name in held.names else "average")) for frame in found]
    return _reduced(body, shapes, squares, held, found, damping, cells)


def _numbers(modes: Any, frequency: Any) -> None:
    if isinstance(modes, bool) or not isinstance(modes, int | np.integer) or modes < 1:
        raise DeclarationError(f"modes must be a positive integer, not {modes!r}")
    if frequency is not None and not (isinstance(frequency, int | float | np.number) and 0 < frequency < np.inf):
        raise DeclarationError(f"frequency must be a positive bound in Hz, not {frequency!r}")


def _reduced(
    body: Solid, shapes: Array, squares: Array, held: Reference, frames: list[Frame], damping: Any, cells: Any
) -> ReducedBody:
    n, count = len(squares), len(body.nodes)
    given = np.asarray(damping)
    ratios = np.broadcast_to(given, (n,)) if given.ndim == 0 else given
    real = np.issubdtype(given.dtype, np.floating) or np.issubdtype(given.dtype, np.integer)
    if ratios.shape != (n,) or not real or not (np.isfinite(ratios) & (ratios >= 0)).all():
        raise DeclarationError(
            f"damping must be a damping ratio of 0 or more for all, or for each of the {n} modes, not {damping!r}"
        )
    places, modes = body.nodes - held.origin, shapes.reshape(count, 3, n)
    integrals = invariants(body.mass, places, modes)
    return ReducedBody(
        **asdict(integrals),
        M=np.eye(n),
        K=np.diag(squares),
        D=np.diag(2 * ratios * np.sqrt(squares)),
        interfaces=tuple(_interface(frame, shapes, held, body) for frame in frames),
        origin=held.origin,
        nodal=NodalField(places, modes, cells),
    )


def _interface(frame: Frame, shapes: Array, held: Reference, body: Solid) -> Interface:
    n, several = shapes.shape[1], len(frame.nodes) > 1
    place = frame.place - held.origin
    place = np.where(np.abs(place) > ROUNDING * body.size, place, 0.0)
    averages = several and frame.kind == "average"
    if frame.name in held.names:
        # Collinear nodes that are all fixed are the reference frame itself, with all rotations; a single node has none.
        still = np.zeros((3, n))
        return Interface(frame.name, frame.place - held.origin, still, still, several, frame.orientation, averages)
    maps = frame.maps @ shapes[frame.equations]
    size = ROUNDING * np.abs(shapes).max(axis=0)
    displacement = np.where(np.abs(maps[:3]) > size, maps[:3], 0.0)
    rotation = np.where(np.abs(maps[3:]) > size / frame.radius, maps[3:], 0.0)
    return Interface(frame.name, place, displacement, rotation, frame.turns, frame.orientation, averages)
