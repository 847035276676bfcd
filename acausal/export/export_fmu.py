"""Export a model as a Functional Mock-up Unit."""

from __future__ import annotations

import hashlib
import re
import uuid
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel, compile
from acausal.compiler.runtime import VERSION
from acausal.core.model_file import framed
from acausal.errors import ExportError
from acausal.export.archive import check_fmu, source_names, write_fmu
from acausal.export.beginning import begin
from acausal.export.content import Content, watched
from acausal.export.description import Description, Variable, is_solved
from acausal.export.full_model import exported
from acausal.export.function_calls import refuse_calls
from acausal.export.given import Role, given
from acausal.export.reach import Reach
from acausal.export.table import TIME, Table
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.language.docstring import first_line
from acausal.language.functions import time
from acausal.locks import exclusive
from acausal.policy import POLICY
from acausal.simulation.model_settings import effective_settings
from acausal.simulation.settings_checks import checked_task
from acausal.solve.problem import Problem
from acausal.solve.run import sizes_of_run
from acausal.symbols import picked, scalars, stacked


@checked_arguments
@exclusive
def export_fmu(
    model: Component | CompiledModel,
    path: str | Path,
    *,
    fmi_version: int = 3,
    parameters: Mapping[str, Any] | None = None,
    platforms: Sequence[str] = ("own",),
    free: Sequence[str] = (),
    stop_time: float | None = None,
    tolerance: float | None = None,
    initial: str | None = None,
    full: bool = False,
) -> None:
    """Write a model as a Functional Mock-up Unit, for Model Exchange and Co-Simulation.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    path : str or Path
        Name of the file, which is written atomically and must end in .fmu.
    fmi_version : 2 or 3
        Version of the Functional Mock-up Interface.
    parameters : mapping of str to value, optional
        Values by path, as of `simulate`.
    platforms : sequence of str
        Platforms of the included libraries: names, "own" or "all".
    free : sequence of str
        Parameters that remain in the equations although they are 0.
    stop_time, tolerance, initial : optional
        Default experiment and kind of initialisation, as of `simulate`. The stop time is 1 s if the model declares none.
    full : bool
        Whether unknowns that stay 0 are states, which importers can set; otherwise they are constants.

    Raises
    ------
    ExportError
        If the file cannot be written, or the model cannot be exported.
    """
    check_fmu(path, fmi_version, platforms)
    compiled, p = _freed(model, parameters, free, full) if free else exported(model, parameters, full)
    refuse_calls(compiled)
    own = effective_settings(compiled, None, {"stop_time": stop_time})["stop_time"]
    asked = {"stop_time": 1.0 if own is None else own, "tolerance": tolerance, "initial": initial, "accuracy": None}
    others = dict.fromkeys(("intervals", "method", "constraints", "max_order"))
    task, _ = checked_task(compiled, None, asked | others)
    span, tolerance = float(task.stop_time), float(task.tolerance)
    problem = Problem(compiled, p, POLICY.loops.feedback / span)
    breaks = [b for b in compiled.guards.breaks(p)[0].tolist() if 0 < b < span]
    beginning = begin(problem, 0.0, min(breaks, default=span) / 2, task.initial)
    known = given(compiled, p, beginning)
    guards = watched(compiled, known)
    # From a run, because an importer cannot repeat a run with other nominal values.
    nominal = sizes_of_run(compiled, p, replace(task, tolerance=max(tolerance, POLICY.sizes.looking)))
    table = Table(compiled, known, beginning, nominal, tolerance, guards)
    variables = table.variables()
    content = Content(problem, beginning, known, nominal, guards, stacked(table.shown), span, tolerance)
    sections = content.sections
    token = _token(framed(VERSION, sections))
    whole = framed(VERSION, {**sections, "token": token.encode() + b"\0"})
    write_fmu(path, _described(content, table, variables, token), whole, fmi_version, platforms)


def _described(content: Content, table: Table, variables: tuple[Variable, ...], token: str) -> Description:
    """Return the interface of a model."""
    compiled = content.compiled
    name = type(compiled.tree).__name__
    solved = {v.reference for v in variables} - {v.reference for v in variables if not is_solved(v)}
    outputs = tuple(v.reference for v in variables if v.causality == "output")
    first = table.first_shown + len(table.shown)
    indicators = tuple(range(first, first + len(content.watched)))
    return Description(
        name=name,
        identifier=re.sub(r"\W", "_", name, flags=re.ASCII),
        token=token,
        description=first_line(type(compiled.tree)),
        version=version("acausal"),
        variables=variables,
        states=table.states,
        rates=table.rates,
        outputs=outputs,
        indicators=indicators,
        dependencies=_dependencies(content, table, outputs, indicators),
        initial_unknowns=_initial(content, table, solved, outputs),
        start_time=0.0,
        stop_time=content.span,
        tolerance=content.tolerance,
        step_size=content.span / POLICY.defaults.intervals,
        completes=bool(compiled.constraints.size),
        sources=source_names(),
    )


def _freed(
    model: Component | CompiledModel, parameters: Mapping[str, Any] | None, free: Sequence[str], full: bool
) -> tuple[CompiledModel, np.ndarray]:
    """Compile a model with some parameters in its equations although they are 0."""
    if isinstance(model, Component):
        compiled = compile(model, parameters, free=free, full=full)
    elif model.source is None:
        raise ExportError("parameters are kept free during compilation: pass the model, not a compiled one.")
    else:
        source, kept = model.source, {"full": True} if full else {}
        compiled = source.make(source.model, {**source.parameters, **(parameters or {})}, free=free, **kept)
    return compiled, compiled.parameter_values(None)


def _token(content: bytes) -> str:
    """Return the GUID of a model, a hash of its content."""
    return f"{{{uuid.UUID(bytes=hashlib.sha256(content).digest()[:16])}}}"


def _expressions(content: Content, table: Table, references: Sequence[int]) -> dict[int, ca.SX]:
    """Return the expressions of rates, variables and indicators."""
    rates = dict(zip(table.rates, scalars(content.runtime.running[0]), strict=True))
    shown = {table.first_shown + k: e for k, e in enumerate(scalars(content.runtime.moving(stacked(table.shown))))}
    first = table.first_shown + len(table.shown)
    excess = scalars(content.runtime.moving(picked(content.problem.compiled.guards.excess, content.watched)))
    watched = {first + k: e for k, e in enumerate(excess)}
    return {k: e for k, e in (rates | shown | watched).items() if k in set(references)}


def _dependencies(
    content: Content, table: Table, outputs: Sequence[int], indicators: Sequence[int]
) -> dict[int, tuple[int, ...]]:
    """Return the states and inputs on which rates, outputs and indicators depend, and whether they depend on time."""
    r = content.problem.compiled.reduced
    inputs = [k for k, _ in content.given.inputs]
    knowns = ca.vertcat(time.sx, r.x, picked(content.given.symbols, inputs))
    references = [TIME, *table.states, *(table.parameters + k for k in inputs)]
    reach = Reach(content.runtime.running[1], r.z, knowns)
    found = _expressions(content, table, [*outputs, *table.rates, *indicators])
    return {k: tuple(references[j] for j in reach(e)) for k, e in found.items()}


def _initial(content: Content, table: Table, solved: set[int], outputs: Sequence[int]) -> dict[int, tuple[int, ...]]:
    """Return the dependencies of the initial unknowns."""
    r, own = content.problem.compiled.reduced, content.given
    settable = [k for k, role in enumerate(own.roles) if role is not Role.INNER]
    state_of = {place: state for state, place in own.starts.items()}
    references = [table.states[state_of[k]] if k in state_of else table.parameters + k for k in settable]
    y = ca.vertcat(r.x, r.z)
    reach = Reach(content.runtime.moving(content.beginning.residuals), y, picked(own.symbols, settable))
    wanted = sorted(solved & {*outputs, *table.rates, *table.states})
    expressions = _expressions(content, table, wanted)
    expressions |= dict(zip(table.states, scalars(r.x), strict=True))
    return {k: tuple(sorted(references[j] for j in reach(expressions[k]))) for k in wanted}
