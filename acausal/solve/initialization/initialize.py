"""Consistent initial values: a damped Newton iteration on the initial system, in the user's words where it fails."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.local import Local
from acausal.compiler.once import latest
from acausal.compiler.report import AtStart
from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.conflicts import contradiction
from acausal.solve.diagnosis.initialization import missing_text
from acausal.solve.initialization.block_solve import by_blocks
from acausal.solve.initialization.complete_by_rank import closed_guess, ranked
from acausal.solve.initialization.coordinate_partitioning import choose_projection, independent_states
from acausal.solve.initialization.equilibrium import rest, rotation
from acausal.solve.initialization.fixed_states import flag_matters, giving, lasting, with_direct
from acausal.solve.initialization.newton import InitialSystem, algebraic, follow, newton, reach
from acausal.solve.initialization.redundancy import Redundancy
from acausal.solve.initialization.steady_rotation import turning_states
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.structure import complete

INITIAL = ("fixed", "guesses", "steady")
TURNING = "turning"  # what "steady" is where nothing rests


@dataclass(frozen=True, eq=False)
class Start:
    """Where a run starts, and what was found there about its loops.

    Attributes
    ----------
    point : Point
        Consistent values.
    redundancy : Redundancy
        Constraints that are dropped.
    loops : Problem or None
        The model, if it has loops.
    """

    point: Point
    redundancy: Redundancy = field(default_factory=Redundancy)
    loops: Problem | None = None

    @cached_property
    def independent_states(self) -> tuple[str, ...]:
        """Names of the states that do not follow from others; none where there are no loops."""
        return independent_states(self.loops, self.point) if self.loops else ()

    def found(self, compiled: CompiledModel) -> AtStart:
        """Return what a report says about it."""
        dropped = (k for k, row in enumerate(compiled.constraints.closures) if row in self.redundancy.dropped)
        return AtStart(tuple(dropped), self.redundancy.singular, self.independent_states)


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
        What to do with states that no condition determines: refuse, take their guesses, find those at which all
        derivatives vanish, or all but those of cyclic coordinates.

    Raises
    ------
    InitializationError
        If conditions are missing or contradict each other, or no solution is found.
    """
    compiled, loops = problem.compiled, bool(problem.compiled.constraints.size)
    at, redundancy = first_guess(problem, time, head), Redundancy()
    if initial in ("steady", TURNING):
        first = _sparse(problem, at) if initial == "steady" else None
        at, redundancy, _ = _closed(problem, at)
        at = rest(problem, at, first) if initial == "steady" else rotation(problem, at)
    else:
        if loops:
            system, at, redundancy = _ranked(problem, at, initial)
        else:
            local = problem.local(at, 1.0)
            system = _system(problem, _told(problem, at, local), initial)
            at = with_direct(problem, system.given, at, local)
        try:
            at = _solve(problem, system, at)
        except InitializationError:
            # Where only forces of a singular position lack a value, the closed loops alone determine how to leave that position.
            if not (redundancy.singular and _states_suffice(problem, system)):
                raise
    # The conditions of the initial system no longer hold; the states stay, the rest follows.
    if flag_matters(compiled):
        at = algebraic(problem, at)
    if not loops:
        return Start(at)
    at = replace(at, constants=choose_projection(problem, at, moves=True))
    return Start(at, redundancy, problem)


def initial_system(problem: Problem, at: Point, initial: str) -> InitialSystem:
    """Return the equations that determine a start, at the values that were found for it.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Consistent values at the start.
    initial : str
        As of `initialize`; in equilibrium derivatives take part as conditions.
    """
    if not problem.compiled.constraints.size and initial != "steady":
        return _system(problem, problem.local(at, 1.0), initial)
    steady = initial == "steady"
    given = giving(problem.compiled).items()
    first = {state: row for row, state in reversed(given) if not steady or row in lasting(problem.compiled)}
    turns = turning_states(problem, at) if steady else []
    return _by_ranks(problem, at, {row: state for state, row in first.items()}, initial, float(not steady), turns)


def _told(problem: Problem, at: Point, local: Local) -> Local:
    """Return the equations where they tell which unknowns the conditions depend on: with algebraic unknowns that are solved.

    A velocity that a condition resolves in the world depends on that of the body by the orientation.
    """
    if len(giving(problem.compiled)) == problem.compiled.conditions.numel():
        return local
    try:
        return problem.local(algebraic(problem, at), 1.0)
    except InitializationError:
        return local


def first_guess(problem: Problem, time: float, head: np.ndarray) -> Point:
    """Start values of all unknowns."""
    y = problem.compiled.start(problem.p, time)[0].copy()
    return Point(time, y[: problem.nx], y[problem.nx :], problem.compiled.layout.begin(head, problem.feedback))


def _ranked(problem: Problem, at: Point, initial: str) -> tuple[InitialSystem, Point, Redundancy]:
    """Close the loops, and choose the initial system from there by ranks."""
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
    problem: Problem, at: Point, direct: dict[int, int], initial: str, flag: float = 1.0, turns: list[int] | None = None
) -> InitialSystem:
    """Choose the initial system by ranks at a point where the loops are closed; rates of `turns` need not vanish."""
    nx, nz = problem.nx, problem.nz
    others = [row for row in range(nz, nz + problem.compiled.conditions.numel()) if row not in direct]
    if initial == "steady":
        others += [k - nx for k in range(nx) if k not in (turns or ())]
    return ranked(problem, at, direct, others, initial == "fixed", flag)


def _states_suffice(problem: Problem, system: InitialSystem) -> bool:
    """Whether every condition gives a state by itself."""
    conditions = set(system.rows[system.rows >= problem.nz].tolist())
    return not system.surplus.size and conditions <= {row for row, _ in system.direct}


def _sparse(problem: Problem, at: Point) -> Point | None:
    """Solve for derivatives of 0 with sparse factors, which suits long chains; None where that finds nothing."""
    try:
        system, at, _ = _ranked(problem, at, "steady")
        return _solve(problem, system, at)
    except InitializationError:
        return None


def _closed(problem: Problem, at: Point) -> tuple[Point, Redundancy, dict[int, int]]:
    """Give states the values that conditions state for them, and close the loops around them.

    Returns
    -------
    at : Point
        With closed loops.
    redundancy : Redundancy
        What the ranks of the loops tell.
    direct : dict of int to int
        Condition -> the state that it gives.
    """
    compiled = problem.compiled
    # The first condition on a state gives it, another one must agree.
    first = {state: row for row, state in reversed(giving(compiled).items())}
    direct = {row: state for state, row in first.items()}
    if direct:
        at = with_direct(problem, np.array(list(direct.items())).T, at, problem.local(at, 1.0))
    if not compiled.constraints.size:
        return at, Redundancy(), direct
    at, redundancy = closed_guess(problem, at, first)
    return problem.completed(at), redundancy, direct


def _system(problem: Problem, local: Local, initial: str) -> InitialSystem:
    """Choose conditions, from the pattern of the equations, in each of which those unknowns come first that it depends on most.

    A condition on a velocity then determines a velocity, although it also holds the orientation.
    """
    J = local.pattern
    size = np.abs(np.nan_to_num(local.entries)) * np.repeat(problem.nominal, np.diff(J.indptr))
    order = np.lexsort((-size, J.indices))
    return _chosen(problem.compiled, initial, order.tobytes())


@latest(1)
def _chosen(compiled: CompiledModel, initial: str, order: bytes) -> InitialSystem:
    """Choose conditions; `order` is that of the entries of the Jacobian, row by row."""
    nx, nz = compiled.nx, compiled.nz
    rows = _rows(compiled, np.frombuffer(order, dtype=np.intp))
    equations, conditions = rows[nx : nx + nz], rows[nx + nz :]
    given = len(conditions)
    done = complete(equations, conditions, nx + nz)
    guessed = list(done.free)
    if any(k >= nx for k in done.free):
        # Some algebraic unknown is left over instead: let guesses of states replace conditions, those that conditions tell last.
        told = {row[0] for row in conditions if row}
        states = sorted(range(nx), key=lambda k: (not _is_guessed(compiled, k), k in told))
        done = complete(equations, [*conditions, *([k] for k in states)], nx + nz)
        guessed = [states[k - given] for k in done.used if k >= given]
    if guessed and initial == "fixed":
        raise InitializationError(missing_text(compiled, guessed))
    used = [nz + k for k in done.used if k < given]
    surplus = [nz + k for k in done.surplus if k < given]
    direct = {row: state for row, state in giving(compiled).items() if row in used}
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
        allowed = POLICY.newton.consistent * reach(local, at.y, problem.nominal)[problem.nx :]
        value = local.value[problem.nx :]
        wrong = [k for k in system.surplus if abs(value[k]) > allowed[k]]
        if wrong:
            raise InitializationError(contradiction(problem, system, at, wrong))
    return at


def _solution(problem: Problem, system: InitialSystem, at: Point) -> Point:
    """Solve the initial system; where all states are known and no equation is of the start alone, as in a run."""
    known = len(system.known) == problem.nx and np.array_equal(system.rows, np.arange(problem.nz))
    if known and not flag_matters(problem.compiled) and (found := problem.solved(at, POLICY.newton.quick)):
        return found
    try:
        return newton(problem, system, at, 1.0)
    except InitializationError:
        found = follow(problem, system, at) or by_blocks(problem, system, at)
        if found is None:
            raise
        return found
