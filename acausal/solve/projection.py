"""What is chosen for the constraints when numbers are known: which of them count, and along which directions to project.

A constraint is redundant only if its Jacobian lacks rank at consistent positions all around: where the rank rises after
a small motion, the position is singular, and all constraints stay.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr, svd
from scipy.optimize import linear_sum_assignment

from acausal.compiler import CompiledModel
from acausal.solve.closing import close, levels
from acausal.solve.order import state_matrix

RANK = 1e-8
MOTION = 1e-2
WORN = 0.05


@dataclass(frozen=True)
class Redundancy:
    """Constraints that say nothing new, by number, and whether the position is a singular one."""

    dropped: tuple[int, ...]
    singular: bool


def scaled(J: np.ndarray) -> np.ndarray:
    """Rows of length 1; rows that vanish stay."""
    size = np.linalg.norm(J, axis=1, keepdims=True)
    return J / np.where(size > 0, size, 1.0)


def find_redundancy(compiled: CompiledModel, x: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> Redundancy:
    """Compare the rank of the constraint Jacobian at a consistent position and after a small motion."""
    c = compiled.closing
    rows = [r[0] for r in c.rows]

    def jacobian(at: np.ndarray) -> np.ndarray:
        return scaled(c(at, p, t, modes)[1][rows])

    here = jacobian(x)
    if _rank(here) == len(rows):
        return Redundancy((), False)
    free = np.linalg.norm(here, axis=0) > 0
    best, singular = here, False
    for seed in range(3):
        moved = _moved(compiled, x, here, free, seed, p, t, modes)
        there = jacobian(moved) if moved is not None else here
        if _rank(there) > _rank(best):
            best, singular = there, True
    if _rank(best) == len(rows):
        return Redundancy((), True)
    # Those that cannot be dropped come first.
    weight = np.ones(len(rows))
    droppable = {c.closures[k] for k, dual in enumerate(compiled.reduced.flat.closures) if not dual.dual.is_constant()}
    weight[[k for k in range(len(rows)) if k not in droppable]] = 1e3
    order = qr((weight[:, None] * best).T, mode="r", pivoting=True)[1]
    return Redundancy(tuple(sorted(order[_rank(best) :].tolist())), singular)


def _rank(J: np.ndarray) -> int:
    sizes = svd(J, compute_uv=False)
    return int(np.sum(sizes > RANK * max(J.shape)))


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
    _, sizes, V = svd(J[:, free])
    null = V[np.sum(sizes > RANK * max(J.shape)) :]
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
    selected: bool = False,
) -> np.ndarray:
    """Return the constants of a segment with D chosen anew at a consistent point.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    x, z, p, t, modes
        A consistent point, and the constants of the segment before; without z all coordinates count alike.
    selected : bool
        True makes some coordinates follow from the others (pivoted choice of states), False projects along the constraint
        Jacobian, stiff coordinates the less.
    """
    c = compiled.closing
    on = np.ones(c.size, dtype=bool)
    for k, constraint in enumerate(c.closures):
        on[list(c.rows[constraint])] = modes[switches_of(compiled)][k] > 0
    J = scaled(c(x, p, t, modes)[1]) * on[:, None]
    D = np.zeros_like(J)
    weights = 1 / (1 + _stiffness(compiled, x, z, p, t, modes)) if z is not None else 1.0
    D[tuple(c.entries)] = (J * weights)[tuple(c.entries)]
    if selected:
        D = _select(compiled, D, on)
    chosen = modes.copy()
    chosen[len(modes) - c.entries.shape[1] :] = scaled(D)[tuple(c.entries)]
    return chosen


def switches_of(compiled: CompiledModel) -> slice:
    """Positions of the switches of closures among the constants of a segment."""
    first = compiled.reduced.modes.numel() - compiled.reduced.closing.choice.numel()
    return slice(first, first + len(compiled.closing.closures))


def _stiffness(
    compiled: CompiledModel, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray
) -> np.ndarray:
    """How strongly each coordinate resists, |d der(rate) / d coordinate| in 1/s2; a rate as its coordinate."""
    nx = compiled.nx
    A = state_matrix(compiled.at(x, z, p, t, modes, 0.0).jacobian[: nx + compiled.nz], nx)
    plan = compiled.reduced.plan
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
        block = D[np.ix_(active, columns)]
        order = qr(block, mode="r", pivoting=True)[1][: len(active)]
        size = np.abs(block[:, order])
        pairs = linear_sum_assignment(-np.log(np.maximum(size, 1e-300)))
        for r, k in zip(*pairs, strict=True):
            selection[active[r], columns[order[k]]] = 1.0
    return selection


def worn(compiled: CompiledModel, x: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> float:
    """Smallest singular value of the scaled Jacobian along D, over that of the Jacobian itself: 1 is best."""
    c = compiled.closing
    J = scaled(c(x, p, t, modes)[1])
    D = np.zeros_like(J)
    D[tuple(c.entries)] = modes[len(modes) - c.entries.shape[1] :]
    on = np.linalg.norm(D, axis=1) > 0
    if not on.any():
        return 1.0
    along = svd(J[on] @ scaled(D[on]).T, compute_uv=False)[-1]
    return float(along / max(svd(J[on], compute_uv=False)[-1], 1e-300))
