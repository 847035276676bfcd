"""Start values that are not finite, and the conditions that compare them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.full_residuals import EVENT, Row, full_residuals
from acausal.flatten.component_tree import join, walk
from acausal.flatten.origin import Origin, value_origin
from acausal.language.fields import Variable
from acausal.policy import POLICY
from acausal.solve.diagnosis.not_finite import operation, parameter_remedy
from acausal.solve.diagnosis.probe import Probe
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars

START_VALUE = "start value"
SHOWN = POLICY.causes.shown


def undefined_start_values(problem: Problem, at: Point) -> str:
    """Return the message on start values that are not finite and on conditions that compare them; "" if all are finite.

    A discrete variable may be infinite: the time of an event that never occurs.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Start values of all unknowns and discrete variables.
    """
    discretes, unknown = problem.compiled.reduced.flat.discontinuities.discretes, ~np.isfinite(at.y)
    absent = np.isnan(at.constants.discretes)
    if not (np.any(unknown) or np.any(absent)):
        return ""
    symbols, starts = ([e for pair in discretes for e in scalars(pair[k])] for k in (0, 1))
    by_symbol = {symbols[k].element_hash(): starts[k] for k in np.flatnonzero(absent)}
    probe, lines, remedies = Probe.of(problem, at, 0.0), dict[str, None](), dict[str, None]()
    for name, row in [*_discretes(problem, by_symbol), *_unknowns(problem, np.flatnonzero(unknown))]:
        what = f"  `{name}` of {row.origin.owner}"
        if row.expression.is_constant():
            lines[f"{what} is {float(row.expression):g}"] = None
        else:
            why, operand = operation(row, probe)
            lines[f"{what} {why}"] = None
            remedies[parameter_remedy(problem, probe, [row], operand)] = None
    conditions = dict.fromkeys(
        f"  {row.origin}"
        for row in full_residuals(problem.compiled).rows
        if row.kind == EVENT and any(s.element_hash() in by_symbol for s in ca.symvar(row.expression))
    )
    head = (
        f"at t = {at.time:.6g} s {'this start value is' if len(lines) == 1 else 'these start values are'} not a number:"
    )
    compared = ["These conditions are undefined then:", *list(conditions)[:SHOWN]] if conditions else []
    last = list(filter(None, remedies)) or [f"Give {'it a number' if len(lines) == 1 else 'them numbers'}, start=0."]
    return "\n".join([head, *list(lines)[:SHOWN], *compared, *last])


def _discretes(problem: Problem, starts: Mapping[int, Any]) -> Iterator[tuple[str, Row]]:
    """Yield names and start values of discrete variables, specified by the hashes of their symbols."""
    for component in walk(problem.compiled.tree):
        for field, declared in component.fields.items():
            if isinstance(declared, Variable) and declared.causality == "discrete":
                for symbol in scalars(getattr(component, field).sx):
                    if (start := starts.get(symbol.element_hash())) is not None:
                        yield join(component._path, field), Row(start, value_origin(component, field), START_VALUE)


def _unknowns(problem: Problem, places: Iterable[int]) -> Iterator[tuple[str, Row]]:
    """Yield names and start values of states and algebraic unknowns, specified by their places."""
    reduced = problem.compiled.reduced
    starts, own = scalars(reduced.flat.unknowns.start), (*reduced.plan.states, *reduced.plan.algebraic)
    for k in (own[place] for place in places):
        if k < len(starts):
            path, _, field = reduced.names[k].partition("[")[0].rpartition(".")
            owner = next((c for c in walk(problem.compiled.tree) if c._path == path and field in c.fields), None)
            origin = value_origin(owner, field) if owner else Origin("", "the model", "")
            yield reduced.names[k], Row(starts[k], origin, START_VALUE)
