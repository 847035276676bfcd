"""The model file with which the core runs a model."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.core_equations import core_equations
from acausal.compiler.memo import memoized
from acausal.compiler.runtime import INNER, NOTHING, VERSION, Runtime
from acausal.core import StoredModel
from acausal.core.model_file import floats, framed, ints
from acausal.solve.initialization.assembly import levels
from acausal.solve.initialization.coordinate_partitioning import closing_scales
from acausal.solve.initialization.independent_constraints import closure_of
from acausal.solve.integrate.ladder import Way
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.one_step import are_rates, sizes
from acausal.solve.integrate.settings import Settings
from acausal.solve.point import Point
from acausal.solve.problem import Problem


def stored(problem: Problem, at: Point, works: bool, moves: bool) -> StoredModel:
    """Return what a file holds of a model.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where it starts, consistent.
    works, moves : bool
        As of `core_equations`.
    """
    return StoredModel(
        core_equations(problem.compiled, works, moves),
        at.time,
        *(at.x, at.z, problem.p, at.constants.vector),
        size=problem.nominal[: problem.nx],
        rate=are_rates(problem),
        names=problem.compiled.states,
    )


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
        "layout": runtime.layout(counts, 0, 0, instants.numel(), 0),
        "roles": ints(np.full(r.p.numel(), INNER)),
        "starts": ints(np.full(compiled.nx, -1)),
        "inputs": b"",
        **runtime.square("begin", NOTHING, 3, []),
        **dict.fromkeys(("head", "shown", "timed", "limits"), nothing),
        "instants": runtime.tape(instants if instants.numel() else NOTHING),
        "rules": runtime.rules([]),
        "bounds": b"",
        "limited": b"",
    }


def run_file(problem: Problem, settings: Settings, at: Point, way: Way) -> bytes:
    """Return the model file of a run.

    Parameters
    ----------
    problem : Problem
        The model.
    settings : Settings
        How it is to be integrated.
    at : Point
        Where it is, consistent.
    way : Way
        Its tolerance and projection.
    """
    compiled, nominal = problem.compiled, settings.nominal
    runtime, free = _runtime(compiled, settings.energy, way.moves), np.empty(0, dtype=int)
    start = StoredModel(
        runtime.equations,
        at.time,
        *(at.x, at.z, problem.p, at.constants.vector),
        size=nominal[: compiled.nx],
        rate=are_rates(problem),
        names=compiled.states,
    )
    follows = closing_scales(problem, at, free) if compiled.constraints.size else problem.nominal[: compiled.nx]
    sections = {
        **_sections(compiled, settings.energy, way.moves),
        **start.start,
        "damped": floats(sizes(problem, nominal, settings.spectrum.vibration if METHODS[way.method].damps else 0.0)),
        "nominal": floats([settings.span, way.tolerance, *nominal, *problem.loop_scales, *follows]),
        "natural": floats(nominal[compiled.nx :]),
        "token": b"run\0",
    }
    return framed(VERSION, sections)
