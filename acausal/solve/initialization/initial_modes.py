"""Where a run begins: values, and switches that fit them."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.set_valued import MODE, SHARED
from acausal.compiler.whole import EQUATION, START
from acausal.errors import DeclarationError, InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.not_finite import cause, undefined_equations
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.diagnosis.undefined_conditions import undefined_conditions
from acausal.solve.diagnosis.undefined_start_values import undefined_start_values
from acausal.solve.initialization.complete_by_rank import leave_singular
from acausal.solve.initialization.coordinate_partitioning import choose_projection
from acausal.solve.initialization.equilibrium import Restless
from acausal.solve.initialization.initialize import INITIAL, TURNING, Start, first_guess, initialize
from acausal.solve.initialization.mode_search import MOST_TRIED, ModeSearch
from acausal.solve.initialization.newton import Lost, algebraic
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem

STAGES = (EQUATION, START)
NOT_FINITE = "the equations have no value at the start; check the start values."


# What has no value is looked for and told in the user's words; numpy's warnings would only name our own lines.
@np.errstate(all="ignore")
def start(problem: Problem, time: float, later: float, initial: str, decides: bool = True) -> Start:
    """Find consistent values at the start, and the switches that fit them.

    Parameters
    ----------
    problem : Problem
        The model.
    time, later : float
        Start time, and a time before the first break.
    initial : "fixed", "guesses" or "steady"
        See `initialize`.
    decides : bool
        Whether an event iteration follows that decides set-valued laws at rest.

    Raises
    ------
    InitializationError
        If no values are found, or none whose switches fit them.
    """
    if initial not in INITIAL:
        remedy = "" if isinstance(initial, str) else " Start values are given in the model: Revolute(phi=fixed(0.1))."
        raise DeclarationError(f"initial is {initial!r}; it must be one of {', '.join(INITIAL)}.{remedy}")
    try:
        return _started(problem, time, later, initial, decides)
    except Restless as error:
        # A rest may lie behind a contact that a steady fall would reach; so steady motion comes last.
        with suppress(InitializationError):
            return _started(problem, time, later, TURNING, decides)
        raise InitializationError(str(error)) from None


def _started(problem: Problem, time: float, later: float, initial: str, decides: bool) -> Start:
    guards, p = problem.compiled.guards, problem.p
    tried = ModeSearch([k for k in guards.watched if k < guards.n_switches])
    decides = decides and initial not in ("steady", TURNING)  # an equilibrium may rest on friction
    head = guards.estimate(p, time, later)[0].copy()
    if text := undefined_start_values(problem, first_guess(problem, time, head)):
        raise InitializationError(text)
    head = _released(problem, head, decides)
    head = tried.next(head, head)
    while head is not None and tried.count <= MOST_TRIED:
        try:
            begun = _begun(problem, time, head, initial)
        except InitializationError as error:
            steady = initial in ("steady", TURNING)
            there = _at_guesses(problem, time, head) if steady and tried.count == 1 else None
            if there is None and isinstance(error, Restless):
                there = _other(_found(problem, error.at, head), head)
            if there is None and not tried.cycle:
                raise
            head = tried.next(head, head if there is None else there)
            continue
        at = begun.point
        new = _released(problem, _found(problem, at, head), decides)
        same = (new == head) | (np.abs(new - head) <= POLICY.switches.same * np.abs(head))
        # Rounding would turn what is in doubt over again and again.
        doubtful = _doubtful(problem, at) if tried.count > 1 and not np.all(same) else np.empty(0, dtype=int)
        same[doubtful] = True
        if np.all(same):
            return replace(begun, point=replace(at, mode=_initial_mode(problem, at, doubtful, head)))
        head = tried.next(head, np.where(same, head, new))
    raise InitializationError(_no_switches(problem.compiled, time, tried))


def _released(problem: Problem, head: np.ndarray, decides: bool) -> np.ndarray:
    """Release set-valued laws at rest, in place, until the first event iteration decides them: they may be redundant."""
    laws = problem.compiled.guards.laws
    places = problem.compiled.guards.n_switches + laws.places
    if decides and len(laws):
        head[places[:, SHARED]] = head[places[:, MODE]] == 0
    return head


def _found(problem: Problem, at: Point, head: np.ndarray) -> np.ndarray:
    """Return the switches and discrete variables that follow from values; what the clock decides stays as in `head`."""
    guards = problem.compiled.guards
    found = guards.start(at.x, at.z, problem.p, at.time, at.constants.vector)[0].copy()
    by_clock = [k for k in guards.timed if k < guards.n_switches]
    found[by_clock] = head[by_clock]
    return found


def _at_guesses(problem: Problem, time: float, head: np.ndarray) -> np.ndarray | None:
    """Return the switches of the guessed states, where what follows from these had other guesses; None for the same ones."""
    try:
        return _other(_found(problem, _begun(problem, time, head, "guesses").point, head), head)
    except InitializationError:
        return None


def _other(found: np.ndarray, head: np.ndarray) -> np.ndarray | None:
    return None if np.array_equal(found, head) else found


def _no_switches(compiled: CompiledModel, time: float, tried: ModeSearch) -> str:
    """Say which conditions find no rest at the start."""
    places = origins_text(compiled, tried.changing or tried.switches)
    if tried.cycle and len(places.splitlines()) == 1:
        return (
            f"at t = {time:g} s this condition contradicts its own consequence, whether it is true or false:\n"
            f"{places}\nGive other start values, or change what holds where it is true, or where it is false."
        )
    return (
        f"no switches fit the values at the start, t = {time:g} s; after {tried.count} rounds these "
        f"conditions still change:\n{places}\n"
        "Give start values at which it is clear which of them hold, or use smooth=True."
    )


def _begun(problem: Problem, time: float, head: np.ndarray, initial: str) -> Start:
    """Initialise, and say why where that fails, or ends where equations have no value or do not determine the unknowns."""
    try:
        begun = initialize(problem, time, head, initial)
    except Lost as lost:
        raise InitializationError(cause(problem, lost.at, lost.flag, STAGES, remedy="") or str(lost)) from None
    if not np.all(np.isfinite(problem.values(begun.point)[: problem.nx + problem.nz])):
        raise InitializationError(undefined_equations(problem, begun.point) or NOT_FINITE)
    if not begun.redundancy.singular and (text := undetermined(problem, begun.point)):
        raise InitializationError(f"at t = {time:.6g} s {text}")
    return begun


def _doubtful(problem: Problem, at: Point) -> np.ndarray:
    """Switches whose condition is but a rounding error away from where it changes."""
    guards: Any = problem.compiled.guards
    watched = np.array(guards.watched, dtype=int)
    if not watched.size:
        return watched
    here = at.x, at.z, problem.p, at.time, at.constants.vector
    scale = np.nan_to_num(guards.scale(*here, problem.nominal)[0])
    near = np.abs(problem.indicators(Rows.of(at))[0][0]) <= POLICY.switches.rounding * np.where(scale > 0, scale, 1.0)
    return watched[near & (watched < guards.n_switches)]


def _initial_mode(problem: Problem, at: Point, doubtful: np.ndarray, head: np.ndarray) -> np.ndarray:
    """Which watched conditions hold at the start; those that act at the start do not hold before.

    Switches that are in doubt are as they are in `head`.
    """
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


def leave_singular_start(problem: Problem, start: Start) -> Point:
    """Leave a singular position, where the equations do not determine how to continue; any other point stays."""
    if not start.redundancy.singular:
        return start.point
    at = leave_singular(problem, start.point)
    at = replace(at, constants=choose_projection(problem, at, spare=False))
    return algebraic(problem, problem.completed(at))


def origins_text(compiled: CompiledModel, guards: list[int]) -> str:
    """List where guards are stated, one per line."""
    origins = dict.fromkeys(str(compiled.guards.guards[k].origin) for k in guards)
    return "\n".join(f"  {origin}" for origin in list(origins)[:5])
