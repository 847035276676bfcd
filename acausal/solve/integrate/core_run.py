"""Runs of the core, made of the model file."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized, memoized_latest
from acausal.compiler.runtime import INNER, NOTHING, VERSION, Runtime
from acausal.core import Run, StoredModel, Unit
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
    # A run begins where it is told: equal models, of any start and parameters, are read once.
    nx, zeros = compiled.nx, np.zeros
    x, z, p, c, size = zeros(nx), zeros(compiled.nz), zeros(r.p.numel()), zeros(r.constants.numel()), zeros(nx)
    start = StoredModel(runtime.equations, 0.0, x, z, p, c, size, are_rates(compiled), compiled.states)
    counts = guards.n_switches, guards.n_discretes, len(compiled.constraints.closures)
    nothing = runtime.tape(NOTHING)
    return {
        **runtime.sections,
        "layout": runtime.layout(counts, 0, len(guards.timed), instants.numel(), 0),
        **start.start,
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


@memoized_latest(2)
def _unit(
    compiled: CompiledModel, energies: bool, moves: bool, sizes: bytes, damped: bytes, nominal: bytes, natural: bytes
) -> Unit:
    """Return the model as the core reads it, with the sections that differ between runs."""
    own = {"sizes": sizes, "damped": damped, "nominal": nominal, "natural": natural, "token": b"run\0"}
    return Unit(framed(VERSION, {**_sections(compiled, energies, moves), **own}))


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
    follows = closing_scales(problem, at) if compiled.constraints.size else problem.nominal[: compiled.nx]
    unit = _unit(
        compiled,
        energy,
        moves,
        floats(nominal[: compiled.nx]),
        floats(sizes(problem, nominal, vibration)),
        floats([span, tolerance, *nominal, *problem.loop_scales, *follows]),
        floats(nominal[compiled.nx :]),
    )
    guards = compiled.guards
    numbers = compiled.nx, compiled.nz, len(at.constants.vector), len(guards.watched), len(guards.timed)
    run = Run(unit, numbers, room)
    if functions:
        run.calls(functions, functions.arguments, functions.results)
    externals = compiled.reduced.flat.parameters.externals
    run.shares = bool(externals)
    run.tell_steps([own.address for own in externals if own.completes])
    return run
