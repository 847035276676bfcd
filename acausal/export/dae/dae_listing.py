"""The readable part of an open DAE: variables, parameters and equations, with the numbers of their expressions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.call import Call
from acausal.compiler.full_residuals import origin_of
from acausal.export.dae.json_values import encoded, without_folder
from acausal.flatten.component_tree import join, walk
from acausal.language import fields as f
from acausal.language.expression import Expr
from acausal.language.functions import time
from acausal.result.lookup import quantity_of
from acausal.symbols import dense, stacked

Add = Callable[[ca.SX | ca.DM], int]


def listing(compiled: CompiledModel, p: np.ndarray, values: Mapping[str, Expr | str], add: Add) -> dict[str, Any]:
    """Return the content of dae.json on a model.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    p : array
        Values of its free parameters.
    values : mapping of str to Expr or str
        Readable quantities by path.
    add : callable
        Function from an expression to its number.
    """
    r, flat = compiled.reduced, compiled.reduced.flat
    parameters = zip(flat.parameters.names, p.tolist(), strict=True)
    return {
        "outputs": list(compiled.outputs),
        "system": {
            "states": add(r.x),
            "algebraic": add(r.z),
            "parameters": add(r.p),
            "constants": add(r.constants),
            "derivatives": add(r.running.ode),
            "residuals": add(r.running.alg),
            "start": add(_start(compiled)),
            "conditions": add(compiled.conditions),
        },
        "parameters": [{"name": name, "value": encoded(value, add)} for name, value in parameters],
        "unknowns": list(_unknowns(compiled, p, add)),
        "equations": [_equation(compiled, k) for k in range(len(r.residuals))],
        "variables": list(_variables(compiled, values, add)),
        "loops": [{"closed_by": [c.a, c.b], "kind": c.kind, "parts": list(c.parts)} for c in flat.loops.cuts],
    }


def unknown_names(compiled: CompiledModel) -> tuple[str, ...]:
    """Return unique names of all unknowns: the state integrated in place of a projected coordinate gets a prefix."""
    r = compiled.reduced
    projected = {p.state for p in r.plan.constrained.projections}
    return tuple(f"integrated.{name}" if k in projected else name for k, name in enumerate(r.names))


def _start(compiled: CompiledModel) -> ca.SX:
    """Return start values of states and algebraic unknowns as expressions of parameters and time."""
    return compiled.start.function(compiled.reduced.p, time.sx)


def _unknowns(compiled: CompiledModel, p: np.ndarray, add: Add) -> Iterator[dict[str, Any]]:
    """Yield the scalar unknowns of all equations, and how each is computed."""
    r = compiled.reduced
    plan, own = r.plan, r.flat.unknowns
    kinds = dict.fromkeys(plan.states, "state") | dict.fromkeys(plan.algebraic, "algebraic")
    kinds |= {k: "assigned" for k, _ in plan.assigned} | {k: "observed" for k, _ in plan.observed}
    derivative_of = {d: k for k, d in enumerate(plan.system.derivative) if d >= 0}
    starts = Call(ca.Function("starts", [r.p, time.sx], [dense(own.start)]))(p, 0.0)[0].tolist()
    coordinate = {one.state: one.coordinate for one in plan.constrained.projections}
    for k, name in enumerate(unknown_names(compiled)):
        same = coordinate.get(k, k)
        known = same < len(starts)
        unit, start, nominal = (own.units[same], starts[same], own.nominal[same]) if known else (None, 0.0, 1.0)
        yield {
            "name": name,
            "unit": None if unit is None else str(unit),
            "start": encoded(start, add),
            "nominal": float(nominal),
            "kind": kinds.get(k, "derivative"),
            "derivative_of": derivative_of.get(k),
        }


def _equation(compiled: CompiledModel, row: int) -> dict[str, Any]:
    r = compiled.reduced
    origin, written = origin_of(r, row), len(r.flat.equations.origins)
    file, _, line = without_folder(origin.where).rpartition(":")
    return {
        "part": origin.path,
        "class": origin.kind,
        "file": file,
        "line": int(line) if line.isdigit() else None,
        "text": origin.text,
        "derivative_of": r.plan.differentiated[row - written]
        if written <= row < written + len(r.plan.differentiated)
        else None,
        "unknowns": [int(k) for k in r.plan.system.rows[row]],
    }


def _variables(compiled: CompiledModel, values: Mapping[str, Expr | str], add: Add) -> Iterator[dict[str, Any]]:
    """Yield the readable quantities as expressions of states, algebraic unknowns, parameters and time."""
    r = compiled.reduced
    found = [
        (field, quantity_of(c, name, field, value))
        for c in walk(compiled.tree)
        for name, field in c.fields.items()
        if isinstance(value := values.get(join(c._path, name)), Expr)
    ]
    column = stacked([q.column for _, q in found])
    resolved = r.running.resolve(column) if column.numel() else column
    first = 0
    for field, q in found:
        kind = (field.causality or "variable") if isinstance(field, f.Variable) else type(field).__name__.lower()
        yield {
            "name": q.name,
            "shape": list(q.shape),
            "units": list(q.units),
            "description": field.description,
            "kind": kind,
            "expression": add(resolved[first : first + q.size] if q.size else ca.SX(0, 1)),
        }
        first += q.size
