"""Consistent initial values: choose the initial system and solve it by a damped Newton iteration."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.linearization import PointLinearization
from acausal.compiler.memo import memoized_latest
from acausal.compiler.report import AtStart
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.conflicts import contradiction
from acausal.solve.diagnosis.initialization import missing_text
from acausal.solve.initialization.block_solve import by_blocks
from acausal.solve.initialization.complete_by_rank import closed_guess, complete_by_rank
from acausal.solve.initialization.coordinate_partitioning import choose_projection, independent_states
from acausal.solve.initialization.equilibrium import find_equilibrium, find_rotation
from acausal.solve.initialization.fixed_states import fixing, steady_conditions, uses_initial_flag, with_fixed_states
from acausal.solve.initialization.newton import InitialSystem, algebraic, homotopy, newton, residual_scale
from acausal.solve.initialization.redundancy import Redundancy
from acausal.solve.initialization.steady_rotation import cyclic_states
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.structure import complete

INITIAL = ("fixed", "guesses", "steady")
TURNING = "turning"  # steady rotation: "steady" of a model without equilibrium


@dataclass(frozen=True, eq=False)
class Start:
    """Consistent start of a run, with the ranks of its loop constraints.

    Attributes
    ----------
    point : Point
        Consistent values.
    redundancy : Redundancy
        Redundant constraints.
    loops : Problem or None
        The model, if it has loops.
    """

    point: Point
    redundancy: Redundancy = field(default_factory=Redundancy)
    loops: Problem | None = None

    @cached_property
    def independent_states(self) -> tuple[str, ...]:
        """Names of the independent states; none without loops."""
        return independent_states(self.loops, self.point) if self.loops else ()

    def found(self, compiled: CompiledModel) -> AtStart:
        """Return the entries of a report."""
        redundant = (k for k, row in enumerate(compiled.constraints.closures) if row in self.redundancy.redundant)
        return AtStart(tuple(redundant), self.redundancy.singular, self.independent_states)


def initialize(problem: Problem, time: float, head: np.ndarray, initial: str) -> Start:
    """Find states and algebraic unknowns that satisfy the equations and the initial conditions.

    Parameters
    ----------
    problem : Problem
        The model.
    time : float
        Start time in s.
    head : array
        Switches at the start, and discrete variables.
    initial : "fixed", "guesses", "steady" or TURNING
        How states are determined that no condition fixes: not at all, which is an error; by their guesses; so that all
        derivatives vanish, or all but those of cyclic coordinates.

    Raises
    ------
    InitializationError
        If conditions are missing or contradictory, or no solution is found.
    """
    compiled, loops = problem.compiled, bool(problem.compiled.constraints.size)
    at, redundancy = first_guess(problem, time, head), Redundancy()
    if initial in ("steady", TURNING):
        first = _sparse(problem, at) if initial == "steady" else None
        at, redundancy, _ = _closed(problem, at)
        at = find_equilibrium(problem, at, first) if initial == "steady" else find_rotation(problem, at)
    else:
        if loops:
            system, at, redundancy = _chosen_by_rank(problem, at, initial)
        else:
            local = problem.local(at, 1.0)
            system = _system(problem, _with_algebraic(problem, at, local), initial)
            at = with_fixed_states(problem, system.fixing, at, local)
        try:
            at = _solve(problem, system, at)
        except InitializationError:
            # In a singular configuration forces may be undefined; the closed loops alone determine how to leave it.
            if not (redundancy.singular and _states_suffice(problem, system)):
                raise
    # The equations of the run replace those of the initial system: the states stay, algebraic unknowns follow.
    if uses_initial_flag(compiled):
        at = algebraic(problem, at)
    if not loops:
        return Start(at)
    at = replace(at, constants=choose_projection(problem, at, moves=True))
    return Start(at, redundancy, problem)


def initial_system(problem: Problem, at: Point, initial: str) -> InitialSystem:
    """Return the initial system that determines a start, chosen at its values.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Consistent values at the start.
    initial : str
        As of `initialize`; derivatives count as conditions in equilibrium.
    """
    if not problem.compiled.constraints.size and initial != "steady":
        return _system(problem, problem.local(at, 1.0), initial)
    steady = initial == "steady"
    fixed = fixing(problem.compiled).items()
    first = {state: row for row, state in reversed(fixed) if not steady or row in steady_conditions(problem.compiled)}
    cyclic = cyclic_states(problem, at) if steady else []
    return _by_ranks(problem, at, {row: state for state, row in first.items()}, initial, float(not steady), cyclic)


def _with_algebraic(problem: Problem, at: Point, local: PointLinearization) -> PointLinearization:
    """Return the equations with algebraic unknowns solved for, so that the Jacobian shows what conditions depend on.

    A velocity resolved in the world, for example, depends on that in the frame of the body through the orientation.
    """
    if len(fixing(problem.compiled)) == problem.compiled.conditions.numel():
        return local
    try:
        return problem.local(algebraic(problem, at), 1.0)
    except InitializationError:
        return local


def first_guess(problem: Problem, time: float, head: np.ndarray) -> Point:
    """Start values of all unknowns."""
    y = problem.compiled.start(problem.p, time)[0].copy()
    return Point(time, y[: problem.nx], y[problem.nx :], problem.compiled.layout.begin(head, problem.feedback))


def _chosen_by_rank(problem: Problem, at: Point, initial: str) -> tuple[InitialSystem, Point, Redundancy]:
    """Close the loops, then choose the initial system by ranks."""
    compiled = problem.compiled
    at, redundancy, direct = _closed(problem, at)
    try:
        at = algebraic(problem, at)
    except InitializationError:
        if not redundancy.singular:
            raise
    system = _by_ranks(problem, at, direct, initial)
    z = at.z.copy()
    z[compiled.constraints.multipliers] = 0.0
    return system, replace(at, z=z), redundancy


def _by_ranks(
    problem: Problem,
    at: Point,
    direct: dict[int, int],
    initial: str,
    flag: float = 1.0,
    cyclic: list[int] | None = None,
) -> InitialSystem:
    """Choose the initial system by ranks at a point with closed loops; rates of `cyclic` states need not vanish."""
    nx, nz = problem.nx, problem.nz
    others = [row for row in range(nz, nz + problem.compiled.conditions.numel()) if row not in direct]
    if initial == "steady":
        others += [k - nx for k in range(nx) if k not in (cyclic or ())]
    return complete_by_rank(problem, at, direct, others, initial == "fixed", flag)


def _states_suffice(problem: Problem, system: InitialSystem) -> bool:
    """Return whether each condition fixes a state by itself."""
    conditions = set(system.rows[system.rows >= problem.nz].tolist())
    return not system.surplus.size and conditions <= {row for row, _ in system.direct}


def _sparse(problem: Problem, at: Point) -> Point | None:
    """Solve for vanishing derivatives with sparse factors, which suits long chains; None if there is no solution."""
    try:
        system, at, _ = _chosen_by_rank(problem, at, "steady")
        return _solve(problem, system, at)
    except InitializationError:
        return None


def _closed(problem: Problem, at: Point) -> tuple[Point, Redundancy, dict[int, int]]:
    """Set states to the values that conditions fix, and close the loops with them.

    Returns
    -------
    at : Point
        With closed loops.
    redundancy : Redundancy
        Redundant constraints.
    direct : dict of int to int
        Condition -> the state that it fixes.
    """
    compiled = problem.compiled
    # The first condition on a state fixes it; further ones must agree.
    first = {state: row for row, state in reversed(fixing(compiled).items())}
    direct = {row: state for state, row in first.items()}
    if direct:
        at = with_fixed_states(problem, np.array(list(direct.items())).T, at, problem.local(at, 1.0))
    if not compiled.constraints.size:
        return at, Redundancy(), direct
    at, redundancy = closed_guess(problem, at, first)
    return problem.completed(at), redundancy, direct


def _system(problem: Problem, local: PointLinearization, initial: str) -> InitialSystem:
    """Choose conditions by matching on the pattern; the unknowns of each equation are sorted by its sensitivity.

    A condition on a velocity then determines a velocity, although it also depends on the orientation.
    """
    J = local.pattern
    size = np.abs(np.nan_to_num(local.entries)) * np.repeat(problem.nominal, np.diff(J.indptr))
    order = np.lexsort((-size, J.indices))
    return _chosen(problem.compiled, initial, order.tobytes())


@memoized_latest(1)
def _chosen(compiled: CompiledModel, initial: str, order: bytes) -> InitialSystem:
    """Choose conditions; `order` is that of the entries of the Jacobian, row by row."""
    nx, nz = compiled.nx, compiled.nz
    rows = _rows(compiled, np.frombuffer(order, dtype=np.intp))
    equations, conditions = rows[nx : nx + nz], rows[nx + nz :]
    n = len(conditions)
    done = complete(equations, conditions, nx + nz)
    guessed = list(done.free)
    if any(k >= nx for k in done.free):
        # An algebraic unknown is left undetermined: guesses of states replace conditions, states without conditions first.
        determined = {row[0] for row in conditions if row}
        states = sorted(range(nx), key=lambda k: (not _is_guessed(compiled, k), k in determined))
        done = complete(equations, [*conditions, *([k] for k in states)], nx + nz)
        guessed = [states[k - n] for k in done.used if k >= n]
    if guessed and initial == "fixed":
        raise InitializationError(missing_text(compiled, guessed))
    used = [nz + k for k in done.used if k < n]
    surplus = [nz + k for k in done.surplus if k < n]
    direct = {row: state for row, state in fixing(compiled).items() if row in used}
    solved = [row for row in used if row not in direct]
    known = sorted([*guessed, *direct.values()])
    return InitialSystem(
        np.array([*range(nz), *solved], int), np.array(surplus, int), np.array(known, int), tuple(direct.items())
    )


def _is_guessed(compiled: CompiledModel, state: int) -> bool:
    guessed, index = compiled.reduced.flat.unknowns.guessed, compiled.reduced.plan.states[state]
    return index < len(guessed) and bool(guessed[index])


def _rows(compiled: CompiledModel, order: np.ndarray) -> list[list[int]]:
    """Unknowns of each equation, from the order of the entries of the Jacobian."""
    J = compiled.pattern
    columns = np.repeat(np.arange(J.shape[1]), np.diff(J.indptr))[order].tolist()
    ends = np.cumsum(np.bincount(J.indices, minlength=J.shape[0])).tolist()
    return [columns[first:last] for first, last in zip([0, *ends], ends, strict=False)]


def _solve(problem: Problem, system: InitialSystem, at: Point) -> Point:
    at = _solution(problem, system, at)
    if system.surplus.size:
        local = problem.local(at, 1.0)
        allowed = POLICY.newton.consistent * residual_scale(local, at.y, problem.nominal)[problem.nx :]
        value = local.value[problem.nx :]
        wrong = [k for k in system.surplus if abs(value[k]) > allowed[k]]
        if wrong:
            raise InitializationError(contradiction(problem, system, at, wrong))
    return at


def _solution(problem: Problem, system: InitialSystem, at: Point) -> Point:
    """Solve the initial system; by the core if all states are known and it differs in no equation from the run."""
    known = len(system.known) == problem.nx and np.array_equal(system.rows, np.arange(problem.nz))
    if known and not uses_initial_flag(problem.compiled) and (found := problem.solved(at, POLICY.newton.quick)):
        return found
    try:
        return newton(problem, system, at, 1.0)
    except InitializationError:
        found = homotopy(problem, system, at) or by_blocks(problem, system, at)
        if found is None:
            raise
        return found
