"""Start of a run: consistent values together with a consistent mode of the switches."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.full_residuals import EQUATION, START
from acausal.errors import DeclarationError, InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.not_finite import cause, undefined_equations
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.diagnosis.undefined_conditions import undefined_conditions
from acausal.solve.diagnosis.undefined_start_values import undefined_start_values
from acausal.solve.initialization.complete_by_rank import leave_singular
from acausal.solve.initialization.coordinate_partitioning import choose_projection
from acausal.solve.initialization.equilibrium import NoEquilibrium
from acausal.solve.initialization.independent_constraints import smallest_singular_value
from acausal.solve.initialization.initialize import INITIAL, TURNING, Start, first_guess, initialize
from acausal.solve.initialization.mode_search import MOST_TRIED, ModeSearch
from acausal.solve.initialization.newton import NoConvergence, algebraic
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem

STAGES = (EQUATION, START)
NOT_FINITE = "the equations have no value at the start; check the start values."


# Values that are not finite are reported as errors of the model; warnings of NumPy would name lines of this package.
@np.errstate(all="ignore")
def start(problem: Problem, time: float, later: float, initial: str) -> Start:
    """Find consistent values at the start, and the mode that agrees with them.

    Parameters
    ----------
    problem : Problem
        The model.
    time, later : float
        Start time, and a time before the first time event.
    initial : "fixed", "guesses" or "steady"
        See `initialize`.

    Raises
    ------
    InitializationError
        If no consistent values, or no consistent mode, are found.
    """
    if initial not in INITIAL:
        remedy = "" if isinstance(initial, str) else " Start values are given in the model: Revolute(phi=fixed(0.1))."
        raise DeclarationError(f"initial is {initial!r}; it must be one of {', '.join(INITIAL)}.{remedy}")
    try:
        return _started(problem, time, later, initial)
    except NoEquilibrium as error:
        # Steady rotation comes last: a steady motion may precede an equilibrium on a contact.
        with suppress(InitializationError):
            return _started(problem, time, later, TURNING)
        raise InitializationError(str(error)) from None


def _started(problem: Problem, time: float, later: float, initial: str) -> Start:
    guards, p = problem.compiled.guards, problem.p
    search = ModeSearch([k for k in guards.watched if k < guards.n_switches])
    releases = initial not in ("steady", TURNING)  # friction may hold an equilibrium
    head = guards.estimate(p, time, later)[0].copy()
    if text := undefined_start_values(problem, first_guess(problem, time, head)):
        raise InitializationError(text)
    if releases:
        guards.laws.release(head)
    head = search.next(head, head)
    while head is not None and search.count <= MOST_TRIED:
        try:
            begun = _initialized(problem, time, head, initial)
        except InitializationError as error:
            steady = initial in ("steady", TURNING)
            implied = _at_guesses(problem, time, head) if steady and search.count == 1 else None
            if implied is None and isinstance(error, NoEquilibrium):
                implied = _different(_implied(problem, error.at, head), head)
            if implied is None and not search.cycle:
                raise
            head = search.next(head, head if implied is None else implied)
            continue
        at = begun.point
        new = _implied(problem, at, head)
        if releases:
            guards.laws.release(new)
        same = (new == head) | (np.abs(new - head) <= POLICY.switches.same * np.abs(head))
        # Switches within round-off of their threshold would alternate for ever.
        doubtful = _doubtful(problem, at) if search.count > 1 and not np.all(same) else np.empty(0, dtype=int)
        same[doubtful] = True
        if np.all(same):
            return replace(begun, point=replace(at, mode=_initial_mode(problem, at, doubtful, head)))
        head = search.next(head, np.where(same, head, new))
    raise InitializationError(_no_mode_text(problem.compiled, time, search))


def _implied(problem: Problem, at: Point, head: np.ndarray) -> np.ndarray:
    """Return the switches and discrete variables that values imply; switches of time alone stay as in `head`."""
    guards = problem.compiled.guards
    found = guards.start(at.x, at.z, problem.p, at.time, at.constants.vector)[0].copy()
    by_clock = [k for k in guards.timed if k < guards.n_switches]
    found[by_clock] = head[by_clock]
    return found


def _at_guesses(problem: Problem, time: float, head: np.ndarray) -> np.ndarray | None:
    """Return the switches that the guesses imply, None if they are those of `head` or there are no consistent values."""
    try:
        return _different(_implied(problem, _initialized(problem, time, head, "guesses").point, head), head)
    except InitializationError:
        return None


def _different(found: np.ndarray, head: np.ndarray) -> np.ndarray | None:
    return None if np.array_equal(found, head) else found


def _no_mode_text(compiled: CompiledModel, time: float, search: ModeSearch) -> str:
    """Return the message that no mode is consistent at the start."""
    places = origins_text(compiled, search.changing or search.switches)
    if search.cycle and len(places.splitlines()) == 1:
        return (
            f"at t = {time:g} s this condition contradicts its own consequence, whether it is true or false:\n"
            f"{places}\nGive other start values, or change the equations of one case."
        )
    return (
        f"no consistent positions of the switches were found at the start, t = {time:g} s; after {search.count} iterations "
        f"these conditions still change:\n{places}\n"
        "Give start values farther from these conditions, or use smooth=True."
    )


def _initialized(problem: Problem, time: float, head: np.ndarray, initial: str) -> Start:
    """Initialise; raise InitializationError with the cause if that fails or the equations are not finite or singular."""
    try:
        begun = initialize(problem, time, head, initial)
    except NoConvergence as lost:
        raise InitializationError(cause(problem, lost.at, lost.flag, STAGES, remedy="") or str(lost)) from None
    if not np.all(np.isfinite(problem.values(begun.point)[: problem.nx + problem.nz])):
        raise InitializationError(undefined_equations(problem, begun.point) or NOT_FINITE)
    if not begun.redundancy.singular and (text := undetermined(problem, begun.point)):
        raise InitializationError(f"at t = {time:.6g} s {text}")
    return begun


def _doubtful(problem: Problem, at: Point) -> np.ndarray:
    """Switches within round-off of their threshold."""
    guards: Any = problem.compiled.guards
    watched = np.array(guards.watched, dtype=int)
    if not watched.size:
        return watched
    here = at.x, at.z, problem.p, at.time, at.constants.vector
    scale = np.nan_to_num(guards.scale(*here, problem.nominal)[0])
    near = np.abs(problem.indicators(Rows.of(at))[0][0]) <= POLICY.switches.rounding * np.where(scale > 0, scale, 1.0)
    return watched[near & (watched < guards.n_switches)]


def _initial_mode(problem: Problem, at: Point, doubtful: np.ndarray, head: np.ndarray) -> np.ndarray:
    """Conditions that hold at the start; those that trigger at the start do not hold before. Doubtful ones as in `head`."""
    guards: Any = problem.compiled.guards
    if not guards.watched:
        return np.zeros(0, dtype=bool)
    value = problem.indicators(Rows.of(at))[0][0]
    if text := undefined_conditions(problem, at, np.array(guards.watched)[np.isnan(value)].tolist()):
        raise InitializationError(f"at t = {at.time:.6g} s {text}")
    own = [guards.guards[k] for k in guards.watched]
    inclusive = np.array([g.inclusive for g in own])
    acts = np.array([g.at_start for g in own])
    found = ((value < 0) | ((value == 0) & inclusive)) & ~acts
    for guard in doubtful.tolist():
        found[guards.watched.index(guard)] = head[guard] > 0
    return found


def leave_singular_start(problem: Problem, start: Start, within: float) -> Point:
    """Return a point beyond a singular start, whose equations do not determine the motion, at a time at most; else the start."""
    singular = start.redundancy.singular
    if not singular and smallest_singular_value(problem, start.point) > POLICY.loops.flat:
        return start.point
    at = leave_singular(problem, start.point, within, not singular)
    at = replace(at, constants=choose_projection(problem, at, spare=False))
    return algebraic(problem, problem.completed(at))


def origins_text(compiled: CompiledModel, guards: list[int]) -> str:
    """Return where conditions are stated, one per line."""
    origins = dict.fromkeys(str(compiled.guards.guards[k].origin) for k in guards)
    return "\n".join(f"  {origin}" for origin in list(origins)[:5])
