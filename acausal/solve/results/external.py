"""Results computed by other means: states of a compiled model at many times, and other values that are not recomputed."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError, InitializationError
from acausal.policy import POLICY
from acausal.result.lookup import Quantity
from acausal.solve.initialization.newton import algebraic
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem
from acausal.solve.results.evaluator import Evaluator
from acausal.solve.results.prescribed import Prescribed
from acausal.symbols import scalars

# Names in a message.
LISTED = 5


def evaluator_of(
    compiled: CompiledModel, p: np.ndarray, times: np.ndarray, specified: Mapping[str, tuple[Quantity, np.ndarray]]
) -> Evaluator:
    """Return the evaluator of a model at specified states.

    Parameters
    ----------
    compiled : CompiledModel
        Without closed loops and discrete variables.
    p : array
        Values of its free parameters.
    times : array, shape (n,)
        In s.
    specified : mapping of str to (Quantity, array)
        Variables of the model, with values of shape (n, entries) in column-major order; every state is among them.

    Raises
    ------
    DeclarationError
        If states are missing, or the model has closed loops or discrete variables.
    """
    _check(compiled)
    prescribed = Prescribed(compiled, _entries(compiled, specified))
    states = prescribed.of_states() if prescribed.entries else {}
    missing = [name for k, name in enumerate(compiled.states) if k not in states]
    if missing:
        shown = ", ".join(f"`{name}`" for name in missing[:LISTED]) + (", ..." if len(missing) > LISTED else "")
        raise DeclarationError(
            f"values of {len(missing)} of {compiled.nx} states are missing: {shown}. A result of a model needs all of its "
            "states, see `compiled.states`"
        )
    x = np.column_stack([states[k][1] for k in range(compiled.nx)]) if states else np.empty((len(times), 0))
    for k, row in np.argwhere(~np.isfinite(x.T))[:1]:
        raise DeclarationError(
            f"the state `{states[k][0]}` is not finite at t = {times[row]:.6g} s: leave out the times from there on"
        )
    problem = Problem(compiled, p)
    solver = Consistent(problem)
    return Evaluator(_rows(problem, solver, times, x), solver, prescribed if prescribed.entries else None)


def _check(compiled: CompiledModel) -> None:
    if compiled.constraints.size:
        raise DeclarationError(
            "the model has closed loops, whose states a run selects at the start and later: no result can be made from "
            "states. Simulate it, or make a result of arrays alone, without model="
        )
    if compiled.guards.n_discretes:
        raise DeclarationError(
            "the model has discrete variables, which states do not determine: no result can be made from states. Simulate it, "
            "or make a result of arrays alone, without model="
        )


def _entries(
    compiled: CompiledModel, specified: Mapping[str, tuple[Quantity, np.ndarray]]
) -> list[tuple[str, Any, np.ndarray]]:
    """Name, symbol and values of each specified scalar of the model."""
    parameters = {s.element_hash() for s in scalars(compiled.reduced.p)}
    found = []
    for path, (quantity, values) in specified.items():
        column = scalars(quantity.column)
        if any(s.is_constant() or s.element_hash() in parameters for s in column):
            raise DeclarationError(f"`{path}` is a parameter of the model: set it by parameters=, or in the model")
        if not all(s.is_symbolic() for s in column):
            raise DeclarationError(f"`{path}` is an expression of other variables: specify these")
        found += [(path, s, values[:, k]) for k, s in enumerate(column)]
    return found


def _rows(problem: Problem, solver: Consistent, times: np.ndarray, x: np.ndarray) -> Rows:
    """Rows of the states, with consistent switches and guesses of the algebraic unknowns."""
    compiled, p = problem.compiled, problem.p
    n, guards = compiled.guards.n_switches, compiled.guards
    if not len(times):
        return Rows(times, x, np.empty((0, compiled.nz)), np.empty((0, compiled.reduced.constants.numel())))
    layout, timed = compiled.layout, [k for k in guards.timed if k < n]
    heads = np.array([guards.estimate(p, t, t)[0].copy() for t in times]).reshape(len(times), -1)
    for row, t in zip(heads, times, strict=True):
        row[timed] = guards.holds_at(p, t, 0.0)[0][: len(timed)]
    guess = np.split(compiled.start(p, times[0])[0], [compiled.nx])[1]
    open_ = np.setdiff1d(np.arange(n), timed)
    for _ in range(POLICY.switches.rounds):
        constants = np.array([layout.begin(head, problem.feedback).vector for head in heads])
        first = Point(float(times[0]), x[0], guess, layout.constants(constants[0]))
        with suppress(InitializationError):  # each row is solved by itself when read
            guess = algebraic(problem, first).z
        rows = Rows(times, x, np.tile(guess, (len(times), 1)), constants)
        if not open_.size:
            return rows
        rows = solver(rows, guards.needs | set(range(compiled.nz)))[0]
        fitting = np.array(
            [guards.start(at.x, at.z, p, at.time, at.constants.vector)[0].copy() for at in _points(problem, rows)]
        )
        if np.array_equal(fitting[:, open_], heads[:, open_]):
            return rows
        heads[:, open_] = fitting[:, open_]
    raise DeclarationError("no positions of the switches are consistent with the states at every time")


def _points(problem: Problem, rows: Rows) -> list[Point]:
    return [problem.point(rows, k) for k in range(len(rows))]
