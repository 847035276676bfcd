"""Consistent initial values: a damped Newton iteration on the initial system, in the user's words where it fails."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError, InitializationError
from acausal.language.functions import initial as initial_flag
from acausal.solve.closed_start import closed_guess, rows_and_knowns
from acausal.solve.newton import CONSISTENT, InitialSystem, follow, newton
from acausal.solve.projection import choose_projection, independent
from acausal.solve.steady import Equilibrium
from acausal.solve.words import contradiction_text, missing_text
from acausal.structure import complete

INITIAL = ("fixed", "guesses", "steady")


def initialize(
    compiled: CompiledModel, p: np.ndarray, time: float, modes: np.ndarray, initial: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find states and algebraic unknowns that satisfy the equations and the initial conditions.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p, time, modes : array, float, array
        Parameters, start time and modes of the switches at the start.
    initial : "fixed", "guesses" or "steady"
        What to do with states that no condition determines: refuse, take their guesses, or find those at which all
        derivatives vanish.

    Returns
    -------
    x, z : arrays
        States and algebraic unknowns.
    modes : array
        Constants of the first segment: the given modes, and what is chosen for constraints.

    Raises
    ------
    InitializationError
        If conditions are missing or contradict each other, or no solution is found.
    """
    if initial not in INITIAL:
        raise DeclarationError(f"initial is {initial!r}; it must be one of {', '.join(INITIAL)}.")
    y = compiled.start(p, time)[0].copy()
    nx = compiled.nx
    modes = np.concatenate([modes, np.ones(compiled.reduced.closing.choice.numel())])
    if initial == "steady":
        first = _sparse(compiled, y, p, time, modes)
        y, modes, _ = _closed(compiled, y, p, time, modes)
        y, modes = Equilibrium(compiled, y, p, time, modes).find(first)
    else:
        if compiled.closing.size:
            system, y, modes = _ranked(compiled, y, p, time, modes, initial)
        else:
            system = _system(compiled, p, time, modes, initial)
            y = _direct_values(compiled, system.direct, y, p, time, modes)
        try:
            y = _solve(compiled, system, y, p, time, modes)
        except InitializationError:
            if not _states_suffice(compiled, system):
                raise
    # The conditions of the initial system hold no longer; the states stay, the rest follows.
    if _flag_matters(compiled):
        y = algebraic(compiled, y, p, time, modes)
    if compiled.closing.size:
        modes = choose_projection(compiled, y[:nx], y[nx:], p, time, modes)
        compiled.cache["independent"] = independent(compiled, modes)
    return y[:nx], y[nx:], modes


def _ranked(
    compiled: CompiledModel, y: np.ndarray, p: np.ndarray, time: float, modes: np.ndarray, initial: str
) -> tuple[InitialSystem, np.ndarray, np.ndarray]:
    """Close the loops, and choose the initial system from there by ranks."""
    nx, nz = compiled.nx, compiled.nz
    y, modes, direct = _closed(compiled, y, p, time, modes)
    try:
        y = algebraic(compiled, y, p, time, modes)
    except InitializationError:
        if not compiled.cache["redundancy"].singular:
            raise
    held = np.array(sorted(direct.values()), dtype=int)
    others = [row for row in range(nz, nz + compiled.conditions.numel()) if row not in direct]
    if initial == "steady":
        others += range(-nx, 0)
    equations, used, surplus, known = rows_and_knowns(
        compiled, y[:nx], y[nx:], p, time, modes, held, others, initial == "fixed"
    )
    y[nx + compiled.closing.multipliers] = 0.0
    rows = np.array([*equations, *used], int)
    demanded = [row for row in surplus if row >= 0]
    return InitialSystem(rows, np.array(demanded, int), np.array(sorted(known), int), tuple(direct.items())), y, modes


def _states_suffice(compiled: CompiledModel, system: InitialSystem) -> bool:
    """Whether only forces of a singular position lack a value: then the closed loops alone tell how to leave it."""
    if not compiled.closing.size or not compiled.cache["redundancy"].singular or system.surplus.size:
        return False
    return set(system.rows[system.rows >= compiled.nz].tolist()) <= {row for row, _ in system.direct}


def _sparse(
    compiled: CompiledModel, y: np.ndarray, p: np.ndarray, time: float, modes: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Solve for derivatives of 0 with sparse factors, which suits long chains; None where that finds nothing."""
    try:
        system, y, modes = _ranked(compiled, y, p, time, modes, "steady")
        return _solve(compiled, system, y, p, time, modes), modes
    except InitializationError:
        return None


def _closed(
    compiled: CompiledModel, y: np.ndarray, p: np.ndarray, time: float, modes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, dict[int, int]]:
    """Give states the values that conditions state for them, and close the loops around them.

    Returns
    -------
    y, modes : arrays
        Unknowns, and constants of the segment.
    direct : dict of int to int
        Condition -> the state that it gives.
    """
    nx, nz = compiled.nx, compiled.nz
    given = compiled.conditions.numel()
    rows = _rows(compiled, p, time, modes)
    direct = _direct(compiled, list(range(nz, nz + given)), rows)
    # The first condition on a state gives it, another one must agree.
    first = {state: row for row, state in reversed(direct.items())}
    direct = {row: state for state, row in first.items()}
    y = _direct_values(compiled, tuple(direct.items()), y, p, time, modes)
    held = np.array(sorted(first), dtype=int)
    if compiled.closing.size:
        y[:nx], modes = closed_guess(compiled, y[:nx], held, p, time, modes)
        y[nx:] = compiled.closing.guess(y[:nx], y[nx:], p, time, modes)
    return y, modes, direct


def _direct_values(
    compiled: CompiledModel,
    direct: tuple[tuple[int, int], ...],
    y: np.ndarray,
    p: np.ndarray,
    time: float,
    modes: np.ndarray,
) -> np.ndarray:
    """Give states the values that conditions state for them."""
    if not direct:
        return y
    local = compiled.at(y[: compiled.nx], y[compiled.nx :], p, time, modes, 1.0)
    rows, states = np.array(direct).T + np.array([[compiled.nx], [0]])
    y = y.copy()
    y[states] -= local.value[rows] / np.asarray(local.jacobian[rows, states]).ravel()
    return y


def algebraic(compiled: CompiledModel, y: np.ndarray, p: np.ndarray, time: float, modes: np.ndarray) -> np.ndarray:
    """Solve for the algebraic unknowns in y = (x, z), with the states as they are."""
    nx = compiled.nx
    system = InitialSystem(np.arange(compiled.nz), np.empty(0, int), np.arange(nx))
    return newton(compiled, system, y, p, time, modes, 0.0)


def _flag_matters(compiled: CompiledModel) -> bool:
    if "flag" not in compiled.cache:
        column = ca.vertcat(compiled.reduced.ode, compiled.reduced.alg)
        compiled.cache["flag"] = any(ca.which_depends(column, initial_flag.sx, 1, True))
    return compiled.cache["flag"]


def _system(compiled: CompiledModel, p: np.ndarray, time: float, modes: np.ndarray, initial: str) -> InitialSystem:
    """Choose conditions, from the pattern of the equations alone."""
    key = ("initial system", initial)
    if key in compiled.cache:
        return compiled.cache[key]
    nx, nz = compiled.nx, compiled.nz
    rows = _rows(compiled, p, time, modes)
    equations, conditions = rows[nx : nx + nz], rows[nx + nz :]
    given = len(conditions)
    done = complete(equations, conditions, nx + nz)
    guessed = list(done.free)
    if any(k >= nx for k in done.free):
        # Some algebraic unknown is left over instead: let guesses of states take the places of conditions.
        states = sorted(range(nx), key=lambda k: not _is_guessed(compiled, k))
        done = complete(equations, [*conditions, *([k] for k in states)], nx + nz)
        guessed = [states[k - given] for k in done.used if k >= given]
    if guessed and initial == "fixed":
        raise InitializationError(missing_text(compiled, guessed))
    used = [nz + k for k in done.used if k < given]
    surplus = [nz + k for k in done.surplus if k < given]
    direct = _direct(compiled, used, rows)
    solved = [row for row in used if row not in direct]
    known = sorted([*guessed, *direct.values()])
    system = InitialSystem(
        np.array([*range(nz), *solved], int), np.array(surplus, int), np.array(known, int), tuple(direct.items())
    )
    compiled.cache[key] = system
    return system


def _is_guessed(compiled: CompiledModel, state: int) -> bool:
    guessed, index = compiled.reduced.flat.unknowns.guessed, compiled.reduced.plan.states[state]
    return index < len(guessed) and bool(guessed[index])


def _rows(compiled: CompiledModel, p: np.ndarray, time: float, modes: np.ndarray) -> list[list[int]]:
    """Unknowns of each equation, those first on which it depends most at the guesses.

    A condition on a velocity then determines a velocity, although it also holds the orientation.
    """
    start = compiled.start(p, time)[0].copy()
    J: Any = compiled.at(start[: compiled.nx], start[compiled.nx :], p, time, modes, 1.0).jacobian.tocoo()
    rows: list[list[int]] = [[] for _ in range(J.shape[0])]
    for k in np.argsort(-np.abs(np.nan_to_num(J.data)), kind="stable"):
        rows[J.row[k]].append(int(J.col[k]))
    return rows


def _direct(compiled: CompiledModel, used: list[int], rows: list[list[int]]) -> dict[int, int]:
    """Conditions that give one state by themselves."""
    if not used:
        return {}
    unknowns = ca.vertcat(compiled.reduced.x, compiled.reduced.z)
    curved = ca.which_depends(compiled.conditions, unknowns, 2, True)
    found: dict[int, int] = {}
    for row in used:
        inside = rows[compiled.nx + row]
        if len(inside) == 1 and inside[0] < compiled.nx and not curved[row - compiled.nz]:
            found[row] = inside[0]
    return found


def _solve(
    compiled: CompiledModel, system: InitialSystem, y: np.ndarray, p: np.ndarray, time: float, modes: np.ndarray
) -> np.ndarray:
    try:
        y = newton(compiled, system, y, p, time, modes, 1.0)
    except InitializationError:
        found = follow(compiled, system, y, p, time, modes)
        if found is None:
            raise
        y = found
    if system.surplus.size:
        value = compiled.at(y[: compiled.nx], y[compiled.nx :], p, time, modes, 1.0).value[compiled.nx :]
        wrong = [k for k in system.surplus if abs(value[k]) > CONSISTENT * (1 + np.max(np.abs(y), initial=0))]
        if wrong:
            raise InitializationError(contradiction_text(compiled, value, wrong))
    return y
