"""What is chosen for the constraints when numbers are known: which of them count, and along which directions to project.

A constraint is redundant only if its Jacobian lacks rank at consistent positions all around: where the rank rises after
a small motion, the position is singular, and all constraints stay.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.solve.closing import close, levels
from acausal.solve.order import state_matrix
from acausal.solve.rank import null_space, pivots, rank, scaled

MOTION = 1e-2
# Positions where ranks are lost are known only as well as the root of how well loops close.
NEARLY = 1e-5
# Where the independent part of a constraint is this small, forces are large enough to stop an integrator.
BESIDE = 1e-3
WORN, SPARED = 0.05, 0.3


@dataclass(frozen=True)
class Redundancy:
    """Constraints that say nothing new, by number, and whether the position is a singular one."""

    dropped: tuple[int, ...]
    singular: bool


def find_redundancy(compiled: CompiledModel, x: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> Redundancy:
    """Compare the rank of the constraint Jacobian at a consistent position and after a small motion."""
    c = compiled.closing
    rows = [r[0] for r in c.rows]

    def jacobian(at: np.ndarray) -> np.ndarray:
        return scaled(c(at, p, t, modes)[1][rows])

    here = jacobian(x)
    if rank(here, NEARLY) == len(rows):
        return Redundancy((), False)
    free = np.linalg.norm(here, axis=0) > 0
    best, singular = here, False
    for seed in range(3):
        moved = _moved(compiled, x, here, free, seed, p, t, modes)
        there = jacobian(moved) if moved is not None else here
        if rank(there, NEARLY) > rank(best, NEARLY):
            best, singular = there, True
    if rank(best) == len(rows):
        return Redundancy((), singular)
    # Those that cannot be dropped come first.
    weight = np.ones(len(rows))
    droppable = {c.closures[k] for k, dual in enumerate(compiled.reduced.flat.closures) if not dual.dual.is_constant()}
    weight[[k for k in range(len(rows)) if k not in droppable]] = 1e3
    order = pivots((weight[:, None] * best).T)
    return Redundancy(tuple(sorted(order[rank(best) :].tolist())), singular)


def is_singular(compiled: CompiledModel, x: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> bool:
    """Whether constraints that are independent elsewhere all but depend on each other in a position."""
    redundancy = compiled.cache.get("redundancy")
    if not compiled.closing.size or redundancy is None:
        return False
    held = [rows[0] for k, rows in enumerate(compiled.closing.rows) if k not in redundancy.dropped]
    return rank(compiled.closing(x, p, t, modes)[1][held], BESIDE) < len(held)


def _moved(
    compiled: CompiledModel,
    x: np.ndarray,
    J: np.ndarray,
    free: np.ndarray,
    seed: int,
    p: np.ndarray,
    t: float,
    modes: np.ndarray,
) -> np.ndarray | None:
    """Return another consistent position near by, along what the constraints leave free."""
    null = null_space(J[:, free])
    if not len(null):
        return None
    direction = null.T @ np.random.default_rng(seed).standard_normal(len(null))
    start = x.copy()
    start[free] += MOTION * direction / np.linalg.norm(direction)
    moved, mismatch = close(compiled, start, np.empty(0, int), p, t, modes, positions=True)
    return moved if mismatch < 1e-10 else None


def choose_projection(
    compiled: CompiledModel,
    x: np.ndarray,
    z: np.ndarray | None,
    p: np.ndarray,
    t: float,
    modes: np.ndarray,
    moves: bool = False,
) -> np.ndarray:
    """Return the constants of a segment with D chosen anew at a consistent point.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    x, z, p, t, modes
        A consistent point, and the constants of the segment before; without z all coordinates count alike.
    moves : bool
        False makes some coordinates follow from the others (pivoted choice of states), True projects along the constraint
        Jacobian as it changes on the way, stiff coordinates the less.
    """
    c = compiled.closing
    on = np.ones(c.size, dtype=bool)
    for k, constraint in enumerate(c.closures):
        on[list(c.rows[constraint])] = modes[switches_of(compiled)][k] > 0
    J = c.held(x[None], p, np.array([t]), modes)[0] * on[:, None]
    stiffness = np.zeros(compiled.nx) if z is None else _stiffness(compiled, x, z, p, t, modes)
    weights = _spared(J, stiffness)
    D = J * weights
    size = np.linalg.norm(D, axis=1, keepdims=True)
    chosen = modes.copy()
    first = len(modes) - c.entries.shape[1]
    chosen[first - 1] = moves
    factors = on[:, None] * weights / np.where(size > 0, size, 1.0)
    chosen[first:] = (factors if moves else _select(compiled, scaled(D), on))[tuple(c.entries)]
    return chosen


def switches_of(compiled: CompiledModel) -> slice:
    """Positions of the switches of closures among the constants of a segment."""
    first = compiled.reduced.modes.numel() - compiled.reduced.closing.choice.numel()
    return slice(first, first + len(compiled.closing.closures))


def independent(compiled: CompiledModel, modes: np.ndarray) -> tuple[str, ...]:
    """Names of the states that do not follow from others."""
    follows = np.any(_directions(compiled, modes) != 0, axis=0)
    return tuple(name for name, other in zip(compiled.states, follows, strict=True) if not other)


def _directions(compiled: CompiledModel, modes: np.ndarray) -> np.ndarray:
    """D, shape (size, nx), from the constants of a segment."""
    c = compiled.closing
    D = np.zeros((c.size, compiled.nx))
    D[tuple(c.entries)] = modes[len(modes) - c.entries.shape[1] :]
    return D


def _stiffness(
    compiled: CompiledModel, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray
) -> np.ndarray:
    """How strongly each coordinate resists, |d der(rate) / d coordinate| in 1/s2; a rate as its coordinate.

    Seen without the projection: constraints at all levels but the highest, and their multipliers, are left out.
    """
    nx, plan, c = compiled.nx, compiled.reduced.plan, compiled.closing
    lower = {row for constraint in plan.constrained.constraints for row in constraint.rows}
    rows = [*range(nx), *(nx + k for k, e in enumerate(plan.residuals) if e not in lower)]
    columns = np.setdiff1d(np.arange(nx + compiled.nz), nx + c.multipliers)
    J = compiled.at(x, z, p, t, modes, 0.0).jacobian[rows][:, columns]
    try:
        A = state_matrix(J, nx)
    except RuntimeError:
        return np.zeros(nx)
    place = {v: k for k, v in enumerate(plan.states)}
    of = {q.coordinate: place[q.state] for q in plan.constrained.projections}
    stiffness = np.zeros(nx)
    for q in plan.constrained.projections:
        if q.rate in of:
            here, rate = of[q.coordinate], of[q.rate]
            stiffness[here] = stiffness[rate] = abs(A[rate, here])
    return stiffness


def _select(compiled: CompiledModel, D: np.ndarray, on: np.ndarray) -> np.ndarray:
    """Unit vectors in place of D: one coordinate for each constraint of a level, by pivots."""
    selection = np.zeros_like(D)
    for rows, columns in levels(compiled):
        active = [r for r in rows if on[r]]
        block = D[active][:, columns]
        order = pivots(block)[: len(active)]
        size = np.abs(block[:, order])
        pairs = scipy.optimize.linear_sum_assignment(-np.log(np.maximum(size, 1e-300)))
        for r, k in zip(*pairs, strict=True):
            selection[active[r], columns[order[k]]] = 1.0
    return selection


def _spared(J: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Weights of the coordinates: stiff ones move as little as keeps the projection well away from the surface.

    Moving them costs energy; they are spared in proportion to their stiffness over a threshold, the lowest that serves.
    """
    for exponent in range(1, 13):
        weights = 1 / (1 + stiffness / 10.0**exponent)
        if float(_transversality(J, J * weights)) >= SPARED:
            return weights
    return np.ones(len(stiffness))


def _transversality(J: np.ndarray, D: np.ndarray) -> np.ndarray:
    """Cosine of the largest angle between the row spaces of J, shape (..., m, n), and D: 1 is best, 0 is singular."""
    on = np.linalg.norm(D, axis=1) > 0
    if not on.any():
        return np.ones(J.shape[:-2])
    held_by, chosen = (np.linalg.qr(np.swapaxes(A[..., on, :], -1, -2))[0] for A in (J, D))
    return np.linalg.svd(np.swapaxes(held_by, -1, -2) @ chosen, compute_uv=False)[..., -1]


def worn(compiled: CompiledModel, x: np.ndarray, p: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
    """How well the projection of a segment still suits each of n positions: 1 is best, 0 is singular.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    x : array, shape (n, nx)
        States.
    p, modes : arrays
        Parameters and constants of the segment.
    t : array, shape (n,)
        Times.
    """
    c = compiled.closing
    return _transversality(c.held(x, p, t, modes)[:, :, c.states], _directions(compiled, modes)[:, c.states])
