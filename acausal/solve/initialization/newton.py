"""Damped Newton iteration on the initial system, and a homotopy where it does not converge."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import scipy

from acausal.compiler import CompiledModel
from acausal.compiler.linearization import PointLinearization
from acausal.compiler.memo import memoized
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.initialization import no_convergence_text, worst_lines
from acausal.solve.initialization.rank import factored
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem
from acausal.solve.sparse_blocks import Block, block_of

NEWTON = POLICY.newton
Solver = Callable[[np.ndarray], np.ndarray]


class NoConvergence(InitializationError):
    """No solution found; `at` is the last iterate, `flag` 1 for the initial system, `worst` lists unsatisfied equations."""

    def __init__(self, text: str, at: Point, flag: float, worst: str = "") -> None:
        super().__init__(text)
        self.at, self.flag, self.worst = at, flag, worst


@dataclass(frozen=True)
class InitialSystem:
    """Equations and unknowns of the initial system.

    Parameters
    ----------
    rows : array of int
        Rows of (alg, conditions) that are solved, as many as unknowns.
    surplus : array of int
        Rows that the solution must satisfy as well.
    known : array of int
        States that are not solved for: they take their guesses, or a condition fixes them.
    direct : tuple of (int, int)
        (row, state) of linear conditions on one state alone.
    """

    rows: np.ndarray
    surplus: np.ndarray
    known: np.ndarray
    direct: tuple[tuple[int, int], ...] = ()
    _blocks: list[Block] = field(default_factory=list, repr=False)

    @cached_property
    def fixing(self) -> np.ndarray:
        """The rows of `direct`, and their states, shape (2, n)."""
        return np.array(self.direct, dtype=int).reshape(-1, 2).T

    def block(self, J: scipy.sparse.csc_matrix, first: int) -> Block:
        """Return its block of the Jacobian of a model, whose first `first` rows are derivatives of states."""
        if not self._blocks:
            free = np.setdiff1d(np.arange(J.shape[1]), self.known)
            self._blocks.append(block_of(J, first + self.rows, free))
        return self._blocks[0]


def homotopy(problem: Problem, system: InitialSystem, at: Point) -> Point | None:
    """Follow F(y) = (1 - s) F(y_0) from s = 0 to 1 (Newton homotopy, Allgower & Georg 1990); None if steps underflow."""
    first = problem.values(at, 1.0)[system.rows + problem.nx].copy()
    s, step = 0.0, NEWTON.first
    while s < 1:
        target = min(1.0, s + step)
        try:
            at = newton(problem, system, at, 1.0, (1 - target) * first)
            s, step = target, NEWTON.growth * step
        except InitializationError:
            step /= NEWTON.shrinkage
            if step < NEWTON.shortest:
                return None
    return at


def newton(problem: Problem, system: InitialSystem, at: Point, flag: float, offset: np.ndarray | float = 0.0) -> Point:
    """Damped Newton iteration with the natural monotonicity test (Deuflhard 2004, section 3.3)."""
    nx, y = problem.nx, at.y
    block = system.block(problem.compiled.pattern, nx)
    rows, free = block.rows, block.columns
    if not free.size:
        return at
    scale = problem.nominal[free]

    def residual(y: np.ndarray) -> np.ndarray:
        return problem.values(at.with_y(y), flag)[rows] - offset

    def failure(value: np.ndarray) -> NoConvergence:
        text = no_convergence_text(problem.compiled, value, system.rows, system.surplus, at.time)
        return NoConvergence(text, at.with_y(y), flag, "\n".join(worst_lines(problem.compiled, value, system.rows)))

    value = residual(y)
    if not np.all(np.isfinite(value)):
        raise failure(value)
    for _ in range(NEWTON.iterations):
        local = problem.local(at.with_y(y), flag)
        # The step of least norm passes points where the block is singular.
        order = "NATURAL" if free[0] == nx else "COLAMD"
        solve = factored(block.sparse(local.entries), scale, POLICY.ranks.least_norm, order)
        step = -solve(value)
        # A correction at round-off level cannot reduce the next one: it ends the iteration.
        if not _change(step, y[free], scale) <= NEWTON.converged:
            found = _damped(residual, solve, y, free, scale, step)
            if found is None:
                break
            y, value, simplified = found
            step = -simplified
        change = _change(step, y[free], scale)
        if change <= NEWTON.converged:
            y[free] += step if change > NEWTON.rounding else 0.0
            if np.any(np.abs(value) > NEWTON.consistent * residual_scale(local, y, problem.nominal)[rows]):
                break
            return at.with_y(y)
    here = residual(y)
    if np.all(np.abs(here) <= round_off(problem.local(at.with_y(y), flag), y, problem.nominal)[rows]):
        return at.with_y(y)
    raise failure(here)


def _change(step: np.ndarray, y: np.ndarray, scale: np.ndarray) -> float:
    """Largest relative change of an unknown."""
    return float(np.max(np.abs(step) / (scale + np.abs(y))))


def _damped(
    residual: Solver, solve: Solver, y: np.ndarray, free: np.ndarray, scale: np.ndarray, step: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Return the damped step that passes the monotonicity test, its residuals and the negative next step, or None."""
    damping = 1.0
    while damping >= NEWTON.damping:
        tried = y.copy()
        tried[free] += damping * step
        value = residual(tried)
        if np.all(np.isfinite(value)):
            simplified = solve(value)
            # Restricted monotonicity test, Deuflhard 2004, section 3.3.
            least = (1 - damping / 4) * np.linalg.norm(step / scale) + NEWTON.floor
            if np.linalg.norm(simplified / scale) <= least:
                return tried, value, simplified
        damping /= 2
    return None


def algebraic(problem: Problem, at: Point) -> Point:
    """Solve for the algebraic unknowns at fixed states."""
    if found := problem.solved(at, NEWTON.quick):
        return found
    try:
        return newton(problem, _algebraic(problem.compiled), at, 0.0)
    except NoConvergence:
        found = _by_passes(problem, at)
        if found is None:
            raise
        return found


def _by_passes(problem: Problem, at: Point) -> Point | None:
    """Solve for the algebraic unknowns block by block; None if that does not converge.

    At a distance d from a singular configuration the smallest pivots are of order d in the constraints of coordinates and
    of rates, and d^2 in those of forces. The product d^4 in one matrix would be below round-off.
    """
    for step in problem.compiled.newton_steps(tuple(range(problem.nz))):
        for _ in range(1 if step.linear else NEWTON.iterations):
            z, own = at.z.copy(), step.unknowns
            z[own] = problem.each(step.function, Rows.of(at))[0]
            change = np.abs(z - at.z)[own] / (problem.nominal[problem.nx + own] + np.abs(z[own]))
            at = replace(at, z=z)
            if not np.max(change) > NEWTON.converged:
                break
    own = slice(problem.nx, problem.nx + problem.nz)
    solved = np.abs(problem.values(at)[own]) <= round_off(problem.local(at), at.y, problem.nominal)[own]
    return at if np.all(solved) else None


@memoized
def _algebraic(compiled: CompiledModel) -> InitialSystem:
    return InitialSystem(np.arange(compiled.nz), np.empty(0, int), np.arange(compiled.nx))


def round_off(local: PointLinearization, y: np.ndarray, nominal: np.ndarray) -> np.ndarray:
    """Return the round-off of residuals; stiff parts make unknowns follow it."""
    return NEWTON.terms * np.finfo(float).eps * residual_scale(local, y, nominal)


def residual_scale(local: PointLinearization, y: np.ndarray, nominal: np.ndarray) -> np.ndarray:
    """Return the change of each residual with unknowns that change by their value and their nominal value."""
    return local.magnitudes(np.abs(y) + nominal)


def terms(local: PointLinearization, y: np.ndarray, nominal: np.ndarray) -> np.ndarray:
    """Return the size of the terms of each row, at least that of its smallest term at nominal values."""
    size, J = local.terms(nominal), local.pattern
    least = np.full(J.shape[0], np.inf)
    np.minimum.at(least, J.indices, np.where(size != 0, size, np.inf))
    # Rows of zeros have no term.
    return local.magnitudes(np.abs(y)) + np.where(least == np.inf, 0.0, least)
