"""Complete the initial system of a model with loops by numerical ranks, at a point where the loops are closed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import missing_text
from acausal.solve.initialization.assembly import close, refuse_open_loops
from acausal.solve.initialization.coordinate_partitioning import choose_projection
from acausal.solve.initialization.fixed_states import soft
from acausal.solve.initialization.independent_constraints import reselected
from acausal.solve.initialization.minimum_norm_reactions import minimum_norm_reactions
from acausal.solve.initialization.newton import InitialSystem, algebraic
from acausal.solve.initialization.rank import factored, is_regular, null_space, outside, pivots, rank
from acausal.solve.initialization.redundancy import Redundancy, find_redundancy
from acausal.solve.point import Point
from acausal.solve.problem import Problem, lengths

LOOPS = POLICY.loops


def closed_guess(problem: Problem, at: Point, fixed: Mapping[int, int]) -> tuple[Point, Redundancy]:
    """Close the loops near the guesses, find redundant constraints, and choose a projection.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Guesses of the states.
    fixed : mapping of int to int
        States that conditions fix -> these; states with soft ones change a little if the loops cannot close otherwise.

    Raises
    ------
    InitializationError
        If a loop cannot close.
    """
    states = np.array(sorted(fixed), dtype=int)
    yielding = [state for state in states.tolist() if fixed[state] in soft(problem.compiled)]
    closed, mismatch = close(problem, at, states, yielding=np.array(yielding, dtype=int))
    if not mismatch <= LOOPS.closed:
        refuse_open_loops(problem, closed, states)
    redundancy = find_redundancy(problem, closed)
    closures = problem.compiled.constraints.closures
    counts = np.array([k not in redundancy.redundant for k in closures], dtype=float)
    closed = replace(closed, constants=replace(closed.constants, closures=counts))
    closed = replace(closed, constants=reselected(problem, closed))
    closed = replace(closed, constants=minimum_norm_reactions(problem, closed))
    left = {k for k, on in zip(closures, closed.constants.closures, strict=True) if not on}
    redundancy = replace(redundancy, redundant=tuple(sorted(left | set(redundancy.redundant) - set(closures))))
    return replace(closed, constants=choose_projection(problem, closed, spare=False, moves=True)), redundancy


def complete_by_rank(
    problem: Problem, at: Point, direct: Mapping[int, int], conditions: list[int], refuse: bool, flag: float = 1.0
) -> InitialSystem:
    """Choose conditions and guesses that complete the initial system, by the ranks of its Jacobian.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        A point where the loops are closed.
    direct : mapping of int to int
        Conditions that fix one state each -> these states.
    conditions : list of int
        Other rows in order of priority, counted from the first algebraic equation; those of derivatives are negative and
        need not hold if the others determine all unknowns.
    refuse : bool
        Whether undetermined states raise InitializationError or take their guesses.
    flag : float, optional
        1 for the initial system, 0 in equilibrium.
    """
    compiled, c, nx, nz = problem.compiled, problem.compiled.constraints, problem.nx, problem.nz
    fixed = sorted(direct.values())
    free = np.setdiff1d(np.arange(nx), fixed)
    rows = nx + np.array(conditions, dtype=int)
    M, C = _reduced(problem, at, free, rows, flag)
    used, surplus = _independent(M, C)
    if surplus:
        # A condition may be independent around the point but not at it. Away from the constraints, where rates violate them,
        # redundant ones would count as independent.
        shake = POLICY.ranks.shake * np.random.default_rng(0).standard_normal(len(free))
        moved = at.x.copy()
        moved[free] += shake * problem.loop_scales[free]
        M, C = _reduced(problem, close(problem, replace(at, x=moved), np.array(fixed, int))[0], free, rows, flag)
        used, surplus = _independent(M, C)
    determined = (M.shape[0] if is_regular(M) else rank(M.toarray())) + len(used)
    left = _left(compiled, np.vstack([M.toarray(), C[used]]), determined, free) if determined < len(free) else []
    if left and refuse:
        raise InitializationError(missing_text(compiled, left))
    plan = compiled.reduced.plan
    position = {e: k for k, e in enumerate(plan.residuals)}
    off = {
        position[row]
        for k, on in zip(c.closures, at.constants.closures, strict=True)
        if not on
        for row in plan.constrained.constraints[k].rows
    }
    equations = [k for k in range(nz) if k not in off]
    demanded = [conditions[k] for k in surplus if conditions[k] >= 0 and conditions[k] not in soft(compiled)]
    known = sorted([*fixed, *left, *(nx + c.multipliers).tolist()])
    solved = [*equations, *(conditions[k] for k in used)]
    return InitialSystem(np.array(solved, int), np.array(demanded, int), np.array(known, int), tuple(direct.items()))


def _reduced(
    problem: Problem, at: Point, free: np.ndarray, rows: np.ndarray, flag: float
) -> tuple[scipy.sparse.csc_matrix, np.ndarray]:
    """Jacobians by the free states of the constraints, and of some rows with algebraic unknowns eliminated."""
    nx, nz = problem.nx, problem.nz
    whole, size = problem.scaled_gradients(at), problem.loop_scales[free]
    M = whole[:, free]
    # What fixed states determine leaves round-off in the columns of the others.
    M.data[(lengths(M) <= POLICY.ranks.rank * lengths(whole))[M.indices]] = 0.0
    if not rows.size:
        return M, np.zeros((0, len(free)))
    J = problem.local(at, flag).jacobian.tocsc()
    inner, right = J[nx : nx + nz, nx:].tocsc(), J[nx : nx + nz][:, free].toarray()
    dz = -factored(inner, problem.nominal[nx:], POLICY.ranks.rank)(right) if nz else right
    return M, (J[rows][:, free].toarray() + J[rows][:, nx:] @ dz) * size


def _independent(M: scipy.sparse.csc_matrix, C: np.ndarray) -> tuple[list[int], list[int]]:
    """Split conditions by Gram-Schmidt: those independent of the constraints and their predecessors, and the others."""
    if not len(C):
        return [], []
    free, basis = outside(M), np.zeros((0, C.shape[1]))
    used, surplus = list[int](), list[int]()
    for k in range(len(C)):
        size = np.linalg.norm(C[k])
        v = C[k] / size if size else C[k]
        for _ in range(2):
            v = free(v)
            v = v - basis.T @ (basis @ v)
        rest = np.linalg.norm(v)
        if rest > POLICY.ranks.independent:
            basis = np.vstack([basis, v / rest])
            used.append(k)
        else:
            surplus.append(k)
    return used, surplus


def _left(compiled: CompiledModel, rows: np.ndarray, independent: int, free: np.ndarray) -> list[int]:
    """Undetermined states: pivots of the null space, states with guesses first."""
    null = null_space(rows, independent)
    if not len(null):
        return []
    given, plan = compiled.reduced.flat.unknowns.guessed, compiled.reduced.plan
    of = {q.state: q.coordinate for q in plan.constrained.projections}
    guessed = [bool(given[of.get(v, v)]) if of.get(v, v) < len(given) else False for v in plan.states]
    weight = np.where(np.array(guessed)[free], POLICY.ranks.guessed, 1.0)
    order = pivots(null * weight)[: len(null)]
    return sorted(int(free[k]) for k in order)


def leave_singular(problem: Problem, at: Point, within: float, regular: bool) -> Point:
    """Continue from a singular configuration along the velocity, to a given time at most.

    A nearly singular one, which is regular, determines accelerations and the branch, and may be at rest.
    """
    x = at.x
    pairs = np.array(problem.rates, dtype=int).reshape(-1, 2)
    moving = np.isin(pairs[:, 0], problem.compiled.constraints.states)
    coordinates, rates = pairs[moving].T
    sizes = problem.loop_scales
    rests = not np.any(np.abs(x[rates]) > LOOPS.rest * sizes[rates])
    if rests and regular:
        return at
    if rests:
        raise InitializationError(
            f"the start at t = {at.time:g} s is a singular configuration at rest: the branch on which the loops continue is "
            "undetermined. Give a velocity, for instance w=fixed(...) of a joint, or start away from it."
        )
    pace = float(np.max(np.abs(x[rates]) / sizes[coordinates]))
    span = min(LOOPS.farther / pace, within - at.time)
    if regular:
        return _farther(problem, at, at, span)
    later = LOOPS.away / pace
    moved = x.copy()
    moved[coordinates] += later * x[rates]
    left = close(problem, replace(at, time=at.time + later, x=moved), np.empty(0, int))[0]
    allowed = LOOPS.stays * np.max(np.abs(x[rates]) / sizes[rates]) * sizes[rates]
    if np.any(np.abs(left.x[rates] - x[rates]) > allowed):
        raise InitializationError(
            f"the start at t = {at.time:g} s is a singular configuration, where branches meet, and the velocities are tangent "
            "to none of them. Give those of one branch (guess(...) leaves dependent joints free), or start 0.01 rad away "
            "from it."
        )
    return _farther(problem, at, left, span)


def _farther(problem: Problem, at: Point, near: Point, span: float) -> Point:
    """Continue from a singular configuration to a time at which accelerations are well known, on the branch of a near point.

    Collocation at the middle and the end of the time: x' is linear between them, and not evaluated at its begin.
    """

    def rate(there: Point) -> np.ndarray:
        there = replace(there, constants=choose_projection(problem, there, spare=False))
        return problem.values(algebraic(problem, problem.completed(there)))[: problem.nx].copy()

    def moved(part: float, step: np.ndarray) -> Point:
        return close(problem, replace(at, time=at.time + part * span, x=at.x + span * step), np.empty(0, int))[0]

    end = near
    try:
        f = g = rate(near)
        for _ in range(LOOPS.iterations):
            middle, end = moved(0.5, (3 * f - g) / 4), moved(1.0, f)
            f, g = rate(middle), rate(end)
    except InitializationError:
        return near
    return end if np.all(np.isfinite(end.x)) else near
