"""Assembly of closed loops: coordinates that satisfy the constraints, near the guesses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.errors import InitializationError
from acausal.flatten.component_tree import walk
from acausal.language.component import Component
from acausal.policy import POLICY
from acausal.solve.diagnosis.loop_directions import nonparallel_directions
from acausal.solve.initialization.fixed_states import fixing, soft
from acausal.solve.initialization.levenberg_marquardt import Matrix, Residuals, levenberg_marquardt
from acausal.solve.initialization.rank import least_norm
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import block_of

LOOPS = POLICY.loops


@memoized
def levels(compiled: CompiledModel) -> list[tuple[list[int], np.ndarray]]:
    """Rows and states of the constraints of each differentiation level, positions first."""
    c = compiled.constraints
    depth = max((len(r) for r in c.rows), default=0)
    found = []
    for d in range(depth, 0, -1):
        rows = [r[len(r) - d] for r in c.rows if len(r) >= d]
        inside = np.isin(c.entries[0], rows)
        found.append((rows, np.unique(c.entries[1][inside])))
    return found


def close(
    problem: Problem,
    at: Point,
    fixed: np.ndarray,
    positions: bool = False,
    yielding: np.ndarray | None = None,
) -> tuple[Point, float]:
    """Satisfy the constraints with the least change of the coordinates, level by level.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Guesses of the states.
    fixed : array of int
        States that do not change.
    positions : bool
        True for the lowest level of each constraint alone: positions, or velocities of nonholonomic constraints.
    yielding : array of int, optional
        Fixed states that may change a little if the loops cannot close otherwise.

    Returns
    -------
    at : Point
        With the states.
    mismatch : float
        Largest scaled residual.
    """
    at = _with_value(problem, at, fixed)
    mismatch = 0.0
    is_lowest = problem.compiled.constraints.is_lowest
    for depth, (rows, columns) in enumerate(levels(problem.compiled)):
        if positions and not any(is_lowest[rows]):
            continue
        rows = [row for row in rows if is_lowest[row]] if positions else rows
        free = np.setdiff1d(columns, fixed)
        own = np.intersect1d(columns, np.empty(0, int) if yielding is None else yielding)
        if own.size and (found := _solve_yielding(problem, at, rows, free, own, depth > 0)):
            at, left = found
        else:
            at, left = _solve(problem, at, rows, free, depth > 0)
        if depth and LOOPS.closed < left <= LOOPS.rough * (1 + np.max(np.abs(at.x) / problem.loop_scales)):
            # Near a singular configuration the error of rates is the square root of that of positions.
            at, left = _solve(problem, at, rows, columns, depth > 0)
        mismatch = max(mismatch, left)
        if left > LOOPS.closed:
            break
    return at, mismatch


def _with_value(problem: Problem, at: Point, fixed: np.ndarray) -> Point:
    """Perturb guesses at which a constraint is not finite, as for joined frames that are half a turn apart."""
    if np.all(np.isfinite(problem.constraints(at)[0])):
        return at
    free = np.setdiff1d(problem.compiled.constraints.states, fixed)
    for k, size in enumerate(LOOPS.attempts):
        start = at.x[free] + size * problem.loop_scales[free] * np.random.default_rng(k).standard_normal(len(free))
        tried = _with(at, free, start)
        if np.all(np.isfinite(problem.constraints(tried)[0])):
            return tried
    return at


def _with(at: Point, free: np.ndarray, u: np.ndarray) -> Point:
    """Return the point with other values of some states."""
    x = at.x.copy()
    x[free] = u
    return replace(at, x=x)


def _residuals(problem: Problem, at: Point, rows: list[int], free: np.ndarray) -> Residuals:
    """Return the function of some states that evaluates scaled residuals of some rows, and their Jacobian."""
    c, (size, rigid) = problem.compiled.constraints, problem.residual_scales_and_rigid(at)
    block, of_entry = block_of(c.pattern, rows, free), np.where(rigid, np.inf, size)[c.pattern.indices]
    matrix = block.sparse if _are_many(rows) else block.dense

    def evaluate(u: np.ndarray) -> tuple[np.ndarray, Matrix]:
        value, entries = c.values(_with(at, free, u).x, problem.p, at.time, at.constants.vector)
        return value[rows] / size[rows], matrix(entries / of_entry)

    return evaluate


def _are_many(rows: list[int]) -> bool:
    return len(rows) > POLICY.ranks.small


def _solve_yielding(
    problem: Problem, at: Point, rows: list[int], free: np.ndarray, soft: np.ndarray, linear: bool
) -> tuple[Point, float] | None:
    """Close one level near the guesses; where a small residual remains, the yielding states change as well.

    Returns
    -------
    at, left
        As of `_solve`; None if a large residual remains.
    """
    near, left = _solve(problem, at, rows, free, linear, LOOPS.attempts[:1])
    size = 1.0
    if linear and LOOPS.closed < left:  # relative to the rates that move
        u = near.x[free]
        size = float(np.max(abs(_residuals(problem, near, rows, free)(u)[1]) @ np.abs(u), initial=0.0))
    if LOOPS.closed < left <= LOOPS.taken * size:
        near, left = _solve(problem, near, rows, np.union1d(free, soft), linear, LOOPS.attempts[:1])
    return (near, left) if left <= LOOPS.closed else None


def _solve(
    problem: Problem,
    at: Point,
    rows: list[int],
    free: np.ndarray,
    linear: bool,
    attempts: tuple[float, ...] = LOOPS.attempts,
) -> tuple[Point, float]:
    """Close one level, linear ones by a single minimum-norm step; return the largest scaled residual as well."""
    evaluate = _residuals(problem, at, rows, free)
    left = float(np.max(np.abs(evaluate(at.x[free])[0]), initial=0.0))
    if not free.size or left == 0:
        return at, left
    best, scale = at.x[free], problem.loop_scales[free]
    if linear:
        best, left = _polish(evaluate, best, scale)
    smallest = left if np.isfinite(left) else np.inf
    for k, size in enumerate(attempts):
        if smallest <= LOOPS.closed:
            break
        start = at.x[free] + size * scale * np.random.default_rng(k).standard_normal(len(free))
        if not np.all(np.isfinite(evaluate(start)[0])):
            continue
        u = levenberg_marquardt(evaluate, start, scale)
        left = float(np.max(np.abs(evaluate(u)[0])))
        if left < smallest:
            best, smallest = u, left
    best, left = _polish(evaluate, best, scale)
    return _with(at, free, best), left


def tighten(problem: Problem, at: Point) -> Point:
    """Close nearly closed loops by a few minimum-norm Newton steps, by `close` if these do not converge."""
    tight = polished(problem, at, np.empty(0, int))
    return close(problem, at, np.empty(0, int))[0] if tight is None else tight


def polished(problem: Problem, at: Point, fixed: np.ndarray) -> Point | None:
    """Close loops by a few minimum-norm Newton steps in the other than the fixed states; None if they do not converge."""
    tight = at
    for rows, columns in levels(problem.compiled):
        free = np.setdiff1d(columns, fixed)
        found, left = _polish(_residuals(problem, tight, rows, free), tight.x[free], problem.loop_scales[free])
        if not left <= LOOPS.closed:
            return None
        tight = _with(tight, free, found)
    return tight


def _polish(evaluate: Residuals, u: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, float]:
    """Take minimum-norm Gauss-Newton steps down to round-off; return the largest residual as well."""
    value, J = evaluate(u)
    for _ in range(LOOPS.polishing):
        tried = u + least_norm(J, scale, POLICY.ranks.polish)(-value)
        there, ahead = evaluate(tried)
        if not np.max(np.abs(there)) < np.max(np.abs(value), initial=0.0):
            break
        u, value, J = tried, there, ahead
    return u, float(np.max(np.abs(value), initial=0.0))


def refuse_open_loops(problem: Problem, at: Point, fixed: np.ndarray, jump: str = "") -> None:
    """Raise InitializationError with the mismatch of all open loops; `jump` is where a jump of states is stated."""
    compiled = problem.compiled
    c, flat = compiled.constraints, compiled.reduced.flat
    value, gap = np.abs(problem.constraints(at)[0]), np.abs(problem.closure_errors(at))
    lines, directions = list[str](), dict[str, None]()
    for number, loop in enumerate(flat.loops.cuts):
        own = [c.rows[c.closures[k]] for k, closure in enumerate(flat.loops.closures) if closure.loop == number]
        by_level = [[rows[level] for rows in own if len(rows) > level] for level in (0, 1)]
        apart = [float(np.max(value[rows], initial=0.0)) if rows else 0.0 for rows in by_level]
        wide = [bool(np.any(gap[rows] > LOOPS.closed)) if rows else False for rows in by_level]
        how = [f"miss each other by {apart[0]:.4g} m or rad", f"move apart at {apart[1]:.4g} m/s or rad/s"]
        for text, open_ in zip(how, wide, strict=True):
            if open_:
                through = f"the loop goes through {', '.join(loop.parts)}" if loop.parts else "no joint is in the loop"
                lines.append(f"  {loop.a} and {loop.b} ({loop.where}) {text}; {through}")
                directions[nonparallel_directions(compiled, loop.parts)] = None
                break
    for k, rows in enumerate(c.rows):
        base = compiled.reduced.plan.constrained.constraints[k].base
        if k not in c.of_loops and np.max(gap[list(rows)]) > LOOPS.closed:
            lines.append(f"  {flat.equations.origins[base]}: off by {np.max(value[list(rows)]):.4g}")
    parts = soft_parts(compiled, fixed)
    named = [compiled.states[k] for k in np.intersect1d(fixed, c.states) if k not in parts]
    if lines and np.max(gap) > LOOPS.closed:
        head = _open_head(at.time, len(lines), bool(named or parts))
        remedy = " ".join([_open_remedy(named), *_soft_remedy(list(parts.values()))])
        if jump:
            names = ", ".join(f"`{name}` = {at.x[compiled.states.index(name)]:.4g}" for name in named)
            loops = "this loop does" if len(lines) == 1 else "these loops do"
            they = "it" if len(named) == 1 else "them"
            head = f"{loops} not close with {names}, to which {jump} sets {they}:"
            remedy = f"Set {they} to values that the loop can reach."
        raise InitializationError("\n".join([head, *lines, *filter(None, directions), remedy]))


def _open_head(time: float, n: int, fixed: bool) -> str:
    one, at = n == 1, f"at t = {time:g} s"
    if fixed:
        return f"{'this loop does' if one else 'these loops do'} not close {at} with the fixed start values:"
    which = "this loop closes" if one else "these loops close"
    return f"{at} no position of the joints was found in which {which}:"


def soft_parts(compiled: CompiledModel, fixed: np.ndarray) -> dict[int, Component]:
    """Components whose soft conditions fix states, by these states."""
    conditions, nz = compiled.reduced.flat.equations.initial, compiled.nz
    of = {state: conditions[row - nz].origin.path for row, state in fixing(compiled).items() if row in soft(compiled)}
    parts = {part._path: part for part in walk(compiled.tree)}
    return {state: parts[of[state]] for state in np.intersect1d(fixed, list(of)).astype(int).tolist()}


def _soft_remedy(parts: list[Component]) -> list[str]:
    """Return the remedy to start parts without their soft conditions."""
    arguments = [f"`{p._path}`: {type(p).__name__}({p.without_soft})" for p in dict.fromkeys(parts) if p.without_soft]
    if not arguments:
        return []
    return [f'Or let the loops determine their shape: {", ".join(arguments)}, with simulate(..., initial="guesses").']


def _open_remedy(fixed: list[str]) -> str:
    if not fixed:
        return "Check lengths, or give better guesses of the joints' positions."
    names = ", ".join(f"`{name}`" for name in fixed)
    what = "Free it" if len(fixed) == 1 else "Free one of them"
    return (
        f"Start values are fixed for {names}. {what}, guess(...) instead of fixed(...); or check lengths and the guesses "
        "of the other joints' positions."
    )
