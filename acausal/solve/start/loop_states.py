"""Which coordinates of loops are states, or along which directions they are projected, once numbers are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.constants import Constants
from acausal.policy import POLICY
from acausal.solve.points import Point, Rows
from acausal.solve.problem import Problem
from acausal.solve.start.loops import levels
from acausal.solve.start.rank import pivots, scaled
from acausal.solve.start.tangent import state_matrix

LOOPS = POLICY.loops


def choose_projection(problem: Problem, at: Point, spare: bool = True, moves: bool = False) -> Constants:
    """Return the constants of a segment with a new choice of D at a consistent point.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        A consistent point, with the constants of the segment before.
    spare : bool
        Whether stiff coordinates count less; the algebraic unknowns must then be consistent, too.
    moves : bool
        False makes some coordinates follow from the others (pivoted choice of states), True projects along the constraint
        Jacobian as it changes on the way, stiff coordinates the less.
    """
    c = problem.compiled.constraints
    on = np.ones(c.size, dtype=bool)
    for constraint, counts in zip(c.closures, at.constants.closures, strict=True):
        on[list(c.rows[constraint])] = counts > 0
    # States count in nominal values: the least change of them, J' over their squares, is the way to the constraints.
    nominal = problem.nominal[: problem.nx]
    J = c.held(at.x[None], problem.p, np.array([at.time]), at.constants.vector)[0] * on[:, None] * nominal
    stiffness = _stiffness(problem, at) if spare else np.zeros(problem.nx)
    weights = _spared(J, stiffness, problem.feedback)
    D = J * weights
    size = np.linalg.norm(D, axis=1, keepdims=True)
    factors = on[:, None] * weights * nominal**2 / np.where(size > 0, size, 1.0)
    chosen = factors if moves else _select(problem.compiled, scaled(D), on) * nominal
    return replace(at.constants, moves=moves, D=chosen[tuple(c.entries)])


def independent(compiled: CompiledModel, constants: Constants) -> tuple[str, ...]:
    """Names of the states that do not follow from others."""
    follows = np.any(_directions(compiled, constants) != 0, axis=0)
    return tuple(name for name, other in zip(compiled.states, follows, strict=True) if not other)


def _directions(compiled: CompiledModel, constants: Constants) -> np.ndarray:
    """D, shape (size, nx), from the constants of a segment."""
    D = np.zeros((compiled.constraints.size, compiled.nx))
    D[tuple(compiled.constraints.entries)] = constants.D
    return D


def _stiffness(problem: Problem, at: Point) -> np.ndarray:
    """How stiff each coordinate is, |d der(rate) / d coordinate| in 1/s2; a rate as its coordinate.

    Seen without the projection: constraints at all levels but the highest, and their multipliers, are left out.
    """
    compiled, nx = problem.compiled, problem.nx
    plan, c = compiled.reduced.plan, compiled.constraints
    lower = {row for constraint in plan.constrained.constraints for row in constraint.rows}
    rows = [*range(nx), *(nx + k for k, e in enumerate(plan.residuals) if e not in lower)]
    columns = np.setdiff1d(np.arange(nx + compiled.nz), nx + c.multipliers)
    J = problem.local(at).jacobian[rows][:, columns]
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
        pairs = scipy.optimize.linear_sum_assignment(-np.log(np.maximum(size, np.finfo(float).tiny)))
        for r, k in zip(*pairs, strict=True):
            selection[active[r], columns[order[k]]] = 1.0
    return selection


def _spared(J: np.ndarray, stiffness: np.ndarray, feedback: float) -> np.ndarray:
    """Weights of the coordinates: stiff ones move as little as keeps the projection well away from the surface.

    Moving them costs energy; they are spared in proportion to their stiffness over a threshold, the lowest that is enough.
    """
    for decade in range(1, LOOPS.decades + 1):
        weights = 1 / (1 + stiffness / (10.0**decade * feedback**2))
        if float(_transversality(J, J * weights)) >= LOOPS.spared:
            return weights
    return np.ones(len(stiffness))


def _transversality(J: np.ndarray, D: np.ndarray) -> np.ndarray:
    """Cosine of the largest angle between the row spaces of J, shape (..., m, n), and D: 1 is best, 0 is singular."""
    on = np.linalg.norm(D, axis=1) > 0
    if not on.any():
        return np.ones(J.shape[:-2])
    held_by, chosen = (np.linalg.qr(np.swapaxes(A[..., on, :], -1, -2))[0] for A in (J, D))
    return np.linalg.svd(np.swapaxes(held_by, -1, -2) @ chosen, compute_uv=False)[..., -1]


def worn(problem: Problem, rows: Rows, constants: Constants) -> np.ndarray:
    """How well the projection of a segment still suits each of n positions: 1 is best, 0 is singular.

    Parameters
    ----------
    problem : Problem
        The model.
    rows : Rows
        Positions of the segment.
    constants : Constants
        Those of the segment.
    """
    c = problem.compiled.constraints
    held, nominal = c.held(rows.x, problem.p, rows.times, constants.vector), problem.nominal[c.states]
    D = _directions(problem.compiled, constants)[:, c.states]
    return _transversality(held[:, :, c.states] * nominal, D / nominal)
