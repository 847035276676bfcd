"""Runs of the core, made of the model file."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.compiler.runtime import INNER, NOTHING, VERSION, Runtime
from acausal.core import Run, StoredModel
from acausal.core.model_file import floats, framed, ints
from acausal.solve.initialization.assembly import levels
from acausal.solve.initialization.coordinate_partitioning import closing_scales
from acausal.solve.initialization.independent_constraints import closure_of
from acausal.solve.integrate.functions import Functions
from acausal.solve.integrate.one_step import are_rates, sizes
from acausal.solve.point import Point
from acausal.solve.problem import Problem


@memoized
def _runtime(compiled: CompiledModel, energies: bool, moves: bool) -> Runtime:
    """Return the run-time object of a model for runs."""
    parameters, watched = compiled.reduced.p, compiled.guards.watched
    return Runtime(compiled, parameters, watched, levels(compiled), closure_of(compiled), energies, moves=moves)


@memoized
def _sections(compiled: CompiledModel, energies: bool, moves: bool) -> dict[str, bytes]:
    """Sections that do not change from run to run."""
    runtime, guards, r = _runtime(compiled, energies, moves), compiled.guards, compiled.reduced
    instants = guards.scheduled.function(r.p, r.constants)
    counts = guards.n_switches, guards.n_discretes, len(compiled.constraints.closures)
    nothing = runtime.tape(NOTHING)
    return {
        **runtime.sections,
        "layout": runtime.layout(counts, 0, len(guards.timed), instants.numel(), 0),
        "roles": ints(np.full(r.p.numel(), INNER)),
        "starts": ints(np.full(compiled.nx, -1)),
        "inputs": b"",
        **runtime.square("begin", NOTHING, 3, []),
        **dict.fromkeys(("head", "shown", "timed", "limits"), nothing),
        "instants": runtime.tape(instants if instants.numel() else NOTHING),
        **runtime.rules(guards.timed),
        "bounds": b"",
        "limited": b"",
    }


def make_run(
    problem: Problem,
    at: Point,
    nominal: np.ndarray,
    span: float,
    tolerance: float,
    *,
    energy: bool = False,
    moves: bool = True,
    vibration: float = 0.0,
    room: int = 1,
    functions: Functions | None = None,
) -> Run:
    """Make a run of the core.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where it is, consistent.
    nominal : array
        Sizes of states and algebraic unknowns.
    span : float
        Length of the whole run in s.
    tolerance : float
        Relative tolerance.
    energy : bool, optional
        Whether to integrate the powers as well.
    moves : bool, optional
        Whether the projection follows the constraint Jacobian.
    vibration : float, optional
        Angular frequency in rad/s from which on vibrations are damped; 0 for none.
    room : int, optional
        Rows of a slice at most.
    functions : Functions, optional
        Functions that are called at events; without them they keep their results.
    """
    compiled = problem.compiled
    runtime = _runtime(compiled, energy, moves)
    start = StoredModel(
        runtime.equations,
        at.time,
        *(at.x, at.z, problem.p, at.constants.vector),
        size=nominal[: compiled.nx],
        rate=are_rates(problem),
        names=compiled.states,
    )
    follows = closing_scales(problem, at) if compiled.constraints.size else problem.nominal[: compiled.nx]
    sections = {
        **_sections(compiled, energy, moves),
        **start.start,
        "damped": floats(sizes(problem, nominal, vibration)),
        "nominal": floats([span, tolerance, *nominal, *problem.loop_scales, *follows]),
        "natural": floats(nominal[compiled.nx :]),
        "token": b"run\0",
    }
    guards = compiled.guards
    numbers = compiled.nx, compiled.nz, len(at.constants.vector), len(guards.watched), len(guards.timed)
    run = Run(framed(VERSION, sections), numbers, room)
    if functions:
        run.calls(functions, functions.arguments, functions.results)
    externals = compiled.reduced.flat.parameters.externals
    run.shares = bool(externals)
    run.tell_steps([own.address for own in externals if own.completes])
    return run
