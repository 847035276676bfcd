"""All equations of a model in all its unknowns, those that are solved explicitly too: for words about what fails."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
import scipy

from acausal.compiler.call import Call
from acausal.compiler.memo import memoized
from acausal.flatten.origin import Origin
from acausal.language.functions import initial, time
from acausal.reduce import ReducedModel
from acausal.symbols import dense, scalars, stacked

EQUATION, START, EVENT = "equation", "initial condition", "condition"


@dataclass(frozen=True)
class Row:
    """An equation, an initial condition or the condition of an event: what is evaluated, and where it is stated."""

    expression: Any
    origin: Origin
    kind: str


@dataclass(frozen=True)
class FullResiduals:
    """All rows of a model.

    Attributes
    ----------
    rows : list of Row
        The equations first, then what is assigned in them, initial conditions and conditions of events.
    names : tuple of str
        Of the unknowns.
    solved : array of int
        Unknowns that are not states, as many as equations.
    unknowns, values, slopes : Call
        The unknowns, from the arguments of the compiled model; values of all rows, and entries of the Jacobian of the
        equations by the unknowns, from unknowns, parameters, time, constants and the flag of the initial system.
    arguments : list of casadi.SX
        Arguments of the last two.
    required : Call
        What components require of variables at the start, from the same.
    """

    rows: list[Row]
    names: tuple[str, ...]
    solved: np.ndarray
    unknowns: Call
    values: Call
    slopes: Call
    arguments: list[ca.SX]
    required: Call

    def jacobian(self, *values: Any) -> np.ndarray:
        """Return the Jacobian of the equations by the unknowns that are solved for."""
        return self.sensitivities(*values)[:, self.solved].toarray()

    def sensitivities(self, *values: Any) -> scipy.sparse.csc_matrix:
        """Return the Jacobian of the equations by all unknowns."""
        pattern = self.slopes.function.sparsity_out(0)
        entries = self.slopes(*values)[0].copy(), np.array(pattern.row()), np.array(pattern.colind())
        return scipy.sparse.csc_matrix(entries, shape=pattern.shape)


@memoized
def full_residuals(compiled: Any) -> FullResiduals:
    """Make the functions of all rows of a compiled model."""
    r: ReducedModel = compiled.reduced
    arguments = [r.unknowns, r.p, time.sx, r.constants, initial.sx]
    equations = [Row(e, origin_of(r, k), EQUATION) for k, e in enumerate(r.residuals)]
    rows = equations + _assigned(r) + _conditions(r)
    known = {s.element_hash() for a in arguments for s in scalars(a)}
    rows = [row for row in rows if all(s.element_hash() in known for s in ca.symvar(row.expression))]
    column = stacked([row.expression for row in rows])
    required = _remaining(r, [statement.sx for statement, _ in compiled.requirements.at_start])
    J = ca.jacobian(stacked([row.expression for row in equations]), r.unknowns)
    return FullResiduals(
        rows=rows,
        names=r.names,
        solved=np.setdiff1d(np.arange(r.unknowns.numel()), r.plan.states),
        unknowns=Call(ca.Function("unknowns", compiled.arguments, [dense(r.resolve(r.unknowns))])),
        values=Call(ca.Function("rows", arguments, [dense(column)])),
        slopes=Call(ca.Function("slopes", arguments, [J])),
        arguments=arguments,
        required=Call(ca.Function("required", arguments, [required])),
    )


def _remaining(r: ReducedModel, entries: list[ca.SX]) -> ca.SX:
    """A column of expressions of the model in unknowns that remain."""
    was, becomes = r.flat.unknowns.eliminated
    return dense(ca.substitute([stacked(entries)], [was], [becomes])[0]) if entries else ca.SX(0, 1)


def origin_of(r: ReducedModel, row: int) -> Origin:
    """Where an equation, or the one of which it is a derivative, is stated."""
    origins, differentiated = r.flat.equations.origins, r.plan.differentiated
    while len(origins) <= row < len(origins) + len(differentiated):
        row = differentiated[row - len(origins)]
    return origins[row] if row < len(origins) else Origin("", "projection of a loop", "")


def _assigned(r: ReducedModel) -> list[Row]:
    """What is assigned: solving for an unknown divides by its coefficient."""
    pairs = (*r.plan.assigned, *r.plan.observed)
    values = scalars(r.definitions[1]) if pairs else []
    return [Row(value, origin_of(r, e), EQUATION) for value, (_, e) in zip(values, pairs, strict=True)]


def _conditions(r: ReducedModel) -> list[Row]:
    """Initial conditions, and conditions of events and switches."""
    flat = r.flat
    found = [Row(c.residual, c.origin, START) for c in flat.equations.initial]
    guards = flat.discontinuities.guards
    excess = _remaining(r, [g.excess for g in guards])
    return found + [Row(e, g.origin, EVENT) for e, g in zip(scalars(excess), guards, strict=True)]
