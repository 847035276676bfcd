"""The initial system of an exported model: one square system for all its unknowns."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.errors import ExportError
from acausal.language.functions import initial as initial_flag
from acausal.language.functions import time as time_symbol
from acausal.solve.initialization.initial_modes import leave_singular_start, start
from acausal.solve.initialization.initialize import initial_system
from acausal.solve.initialization.newton import algebraic
from acausal.solve.initialization.rank import rank
from acausal.solve.integrate.order import Spectrum
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars, stacked

DEPENDENT = 1e-15  # singular value at round-off level, for rows of length 1


@dataclass(frozen=True)
class Beginning:
    """Initial values of an exported model, and their equations.

    Attributes
    ----------
    at : Point
        Consistent values; the projection of closed loops moves.
    residuals : casadi.SX
        Residuals for states and algebraic unknowns, in these, parameters, start values, time and constants.
    starts : dict of int to casadi.SX
        Symbols of the start values that can be changed, by state.
    vibration : float
        Magnitude of the largest oscillatory eigenvalue at the start, in 1/s.
    releases : bool
        Whether set-valued laws at rest have no force at the start, until an event decides them.
    """

    at: Point
    residuals: ca.SX
    starts: dict[int, ca.SX]
    vibration: float
    releases: bool


def begin(problem: Problem, time: float, later: float, initial: str) -> Beginning:
    """Initialise a model, and return the equations of its initial values.

    Parameters
    ----------
    problem : Problem
        The model.
    time, later : float
        Start time, and one before the first break.
    initial : str
        As in `simulate`.

    Raises
    ------
    ExportError
        If the model starts in a singular configuration, where equations do not determine the motion.
    """
    begun = start(problem, time, later, initial)
    at = begun.point
    if leave_singular_start(problem, begun, later) is not at:
        raise ExportError(
            f"the model starts in a singular configuration, t = {time:g} s, from where equations alone lead no further. Let it "
            "start beside that."
        )
    system = initial_system(problem, at, initial)
    flag = float(initial != "steady")
    residuals, starts = _square(problem.compiled, system.rows, system.known, dict(system.direct), flag)
    held = algebraic(problem, problem.projected(at)) if problem.compiled.constraints.size else at
    if initial == "steady":
        _refuse_singular(problem, held, residuals, starts)
    return Beginning(held, residuals, starts, Spectrum(problem, at).vibration, initial != "steady")


def _refuse_singular(problem: Problem, at: Point, residuals: ca.SX, starts: dict[int, ca.SX]) -> None:
    """Raise an error if equations of an equilibrium are dependent up to round-off: an importer could not solve them."""
    r = problem.compiled.reduced
    unknowns = ca.vertcat(r.x, r.z)
    symbols = [unknowns, r.p, time_symbol.sx, r.constants, stacked(list(starts.values()))]
    slopes = ca.Function("slopes", symbols, [ca.jacobian(residuals, unknowns)])
    J = slopes(at.y, problem.p, at.time, at.constants.vector, at.x[list(starts)]).toarray() * problem.nominal
    if rank(J, DEPENDENT) < len(at.y):
        raise ExportError(
            "the equations of this equilibrium depend on one another but for rounding, as of stiff beams in closed loops: an "
            'importer could not solve them. Export it with initial="guesses" or "fixed", and let it come to rest there.'
        )


def _square(
    compiled: CompiledModel, rows: np.ndarray, known: np.ndarray, direct: dict[int, int], flag: float
) -> tuple[ca.SX, dict[int, ca.SX]]:
    """Return the equations of an initial system and their start values; `flag` is 1, or 0 for an equilibrium."""
    r, nx = compiled.reduced, compiled.nx
    equations = ca.substitute(ca.vertcat(r.ode, r.alg, compiled.conditions), initial_flag.sx, flag)
    if r.projections.choice.numel():
        equations = ca.substitute(equations, r.projections.moves, 1)
    entries = scalars(equations)
    unknowns = scalars(ca.vertcat(r.x, r.z))
    found = [entries[nx + row] for row in rows.tolist()]
    starts: dict[int, ca.SX] = {}
    given = {state: entries[nx + row] for row, state in direct.items()}
    for place in known.tolist():
        own = unknowns[place]
        if place >= nx:
            found.append(own)  # a multiplier, which is 0
        elif place in given and not _is_number(given[place], own):
            found.append(given[place])
        else:
            starts[place] = ca.SX.sym(f"start{place}")
            found.append(own - starts[place])
    if len(found) != len(unknowns):
        raise ExportError(
            f"the start has {len(found)} equations for {len(unknowns)} unknowns, which cannot be exported; fix as many "
            "start values as there are freedoms."
        )
    return stacked(found), starts


def _is_number(condition: ca.SX, state: ca.SX) -> bool:
    """Return whether a condition sets a state to a number."""
    return [s.element_hash() for s in ca.symvar(condition)] == [state.element_hash()]
