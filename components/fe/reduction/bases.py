"""Modal bases: fixed-interface (held) modes, free modes and Craig-Bampton bases."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.modes import Flexibility, System, lowest, orthogonal
from components.fe.reduction.node_frames import Frame
from components.fe.reduction.reference_frame import Reference, reference, spread
from components.fe.reduction.solid import Solid

BASES = ("held", "free", "craig-bampton")
# Distance of a unit row from the span of the others below which it counts as linearly dependent: above round-off of the
# projection (1e-14), below any intended difference of interface positions.
DEPENDENT = 1e-8
# Modes computed in the first attempt to reach a frequency bound; each further attempt doubles them.
BATCH = 16


def basis(
    name: str, hold: Any, frames: list[Frame], body: Solid, count: int | None, limit: float
) -> tuple[Array, Array, Reference]:
    """Compute nodal modes, mass-orthonormal and without motion of the reference frame.

    Parameters
    ----------
    name : str
        "held", "free" or "craig-bampton".
    hold : Any
        Definition of the reference frame, see `reduce_body`.
    frames : list of Frame
        Interfaces.
    body : Solid
        The body.
    count : int or None
        Number of modes; None for all below `limit`.
    limit : float
        Frequency bound in Hz.

    Returns
    -------
    modes : array, shape (3 N, n)
        Displacements.
    squares : array, shape (n,)
        Eigenvalues omega^2 in 1/s2.
    held : Reference
        The reference frame.
    """
    if name not in BASES:
        raise DeclarationError(f"basis must be one of {', '.join(map(repr, BASES))}, not {name!r}")
    stiff = [frame for frame in frames if frame.kind == "rigid"]
    if name == "free":
        # Free modes cannot satisfy nodal constraints: the reference frame is fixed to the average of its nodes.
        frames = [replace(frame, kind="average") for frame in frames]
    held = reference(hold, frames, body)
    system = System(body, held.held, stiff)
    rows = (system.expand.T @ held.rows.T).T
    if name == "held":
        shapes, squares = _wanted(Flexibility(system, _independent(rows)), count, limit)
    elif name == "free":
        shapes, squares = _free(system, rows, held, count, limit)
    else:
        shapes, squares = _craig_bampton(system, rows, held, frames, count, limit)
    return system.expand @ shapes, squares, held


def _wanted(flexibility: Flexibility, count: int | None, limit: float) -> tuple[Array, Array]:
    """Compute `count` modes, or all modes below the frequency `limit`."""
    if count is not None:
        return lowest(flexibility, count)
    wanted = BATCH
    while True:
        shapes, squares = lowest(flexibility, wanted)
        if len(squares) < wanted or squares[-1] > (2 * np.pi * limit) ** 2:
            below = squares <= (2 * np.pi * limit) ** 2
            return shapes[:, below], squares[below]
        wanted *= 2


def _free(system: System, rows: Array, held: Reference, count: int | None, limit: float) -> tuple[Array, Array]:
    """Compute the modes of the free body relative to the reference frame."""
    if len(held.held) or len(rows) != 6:
        raise DeclarationError(
            f"hold imposes {len(held.held) + len(rows)} constraints on the reference frame, but free modes can satisfy only six: "
            'hold a frame, three nodes (i, j, k) or "mean-axis"'
        )
    means = (system.mass @ system.rigid).T
    shapes, _ = _wanted(Flexibility(system, means), count, limit)
    shapes = shapes if count is None else shapes[:, :count]
    return orthogonal(system, Flexibility(system, rows).relative(shapes))


def _craig_bampton(
    system: System, rows: Array, held: Reference, frames: list[Frame], count: int | None, limit: float
) -> tuple[Array, Array]:
    """Compute the fixed-interface modes and the static modes of unit motions of the interfaces.

    If the reference frame is not an interface, it only defines which motion is rigid; the common rigid motions of all
    interfaces are removed from the static modes.
    """
    own = [spread(frame, system.body) for frame in frames if frame.name not in held.names]
    faces = (system.expand.T @ np.vstack([*own, np.zeros((0, system.expand.shape[0]))]).T).T
    loose = not held.names and not len(held.held)
    fixed = np.zeros((0, rows.shape[1])) if loose else _independent(rows)
    faces = _independent(faces, fixed)
    if loose:
        # Remove the rigid motions that the interfaces leave free, relative to the reference frame.
        _, values, directions = np.linalg.svd(np.vstack([_unit(faces) @ system.rigid, np.zeros((6, 6))]))
        open_ = directions[values <= DEPENDENT * max(values.max(), np.finfo(float).tiny)]
        fixed = open_ @ np.linalg.solve(rows @ system.rigid, rows)
    flexibility = Flexibility(system, np.vstack([fixed, faces]))
    values = np.vstack([np.zeros((len(fixed), len(faces))), np.eye(len(faces))])
    if loose:
        motions = flexibility.rows[len(fixed) :] @ system.rigid
        directions, size, _ = np.linalg.svd(motions)
        values = values @ directions[:, int((size > DEPENDENT * size.max(initial=0.0)).sum()) :]
    static = flexibility.static(values) if values.shape[1] else np.zeros((system.stiffness.shape[0], 0))
    if count is not None and count < static.shape[1]:
        raise DeclarationError(
            f"the Craig-Bampton basis of these frames has {static.shape[1]} static modes, but modes={count}; "
            f"use modes={static.shape[1]} or more"
        )
    wanted = None if count is None else count - static.shape[1]
    shapes, _ = _wanted(flexibility, wanted, limit)
    shapes = np.hstack([shapes if wanted is None else shapes[:, :wanted], static])
    return orthogonal(system, Flexibility(system, rows).relative(shapes) if loose else shapes)


def _unit(rows: Array) -> Array:
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return rows / np.where(size > 0, size, 1.0)


def _independent(rows: Array, known: Array | None = None) -> Array:
    """Return the rows that are linearly independent of the known rows and of the rows before them (Gram-Schmidt)."""
    basis: list[Array] = []
    kept = []
    nothing = np.finfo(float).eps * np.linalg.norm(rows, axis=1).max(initial=0.0)
    for row in [*([] if known is None else known), *rows]:
        size = np.linalg.norm(row)
        rest = row / size if size > nothing else 0.0 * row
        for _ in range(2):
            for direction in basis:
                rest = rest - direction * (direction @ rest)
        length = np.linalg.norm(rest)
        if length > DEPENDENT:
            basis.append(rest / length)
            kept.append(row)
    return np.array(kept[0 if known is None else len(known) :]).reshape(-1, rows.shape[1])
