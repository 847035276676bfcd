"""All equations of a model in all its unknowns, explicitly solved ones included, for the diagnosis of failures."""

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
    """An equation, an initial condition or an event condition: its expression and its origin."""

    expression: Any
    origin: Origin
    kind: str


@dataclass(frozen=True)
class FullResiduals:
    """All equations, initial conditions and event conditions of a model as numerical functions.

    Attributes
    ----------
    rows : list of Row
        The equations first, then explicitly assigned expressions, initial conditions and event conditions.
    names : tuple of str
        Names of the unknowns.
    solved : array of int
        Unknowns that are not states, as many as equations.
    unknowns : Call
        The unknowns as a function of the arguments of the compiled model.
    values, slopes, required : Call
        Functions of `arguments`: values of all rows, nonzeros of the Jacobian of the equations by the unknowns, and values
        of the requirements on variables at the start.
    arguments : list of casadi.SX
        Unknowns, parameters, time, constants and the flag of the initial system.
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
        """Return the dense Jacobian of the equations by the unknowns that are not states."""
        return self.sensitivities(*values)[:, self.solved].toarray()

    def sensitivities(self, *values: Any) -> scipy.sparse.csc_matrix:
        """Return the sparse Jacobian of the equations by all unknowns."""
        pattern = self.slopes.function.sparsity_out(0)
        entries = self.slopes(*values)[0].copy(), np.array(pattern.row()), np.array(pattern.colind())
        return scipy.sparse.csc_matrix(entries, shape=pattern.shape)


@memoized
def full_residuals(compiled: Any) -> FullResiduals:
    """Build the residual functions of a compiled model."""
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
    """Return a column of expressions with eliminated unknowns substituted."""
    was, becomes = r.flat.unknowns.eliminated
    return dense(ca.substitute([stacked(entries)], [was], [becomes])[0]) if entries else ca.SX(0, 1)


def origin_of(r: ReducedModel, row: int) -> Origin:
    """Return the origin of an equation, or of the equation of which it is a time derivative."""
    origins, differentiated = r.flat.equations.origins, r.plan.differentiated
    while len(origins) <= row < len(origins) + len(differentiated):
        row = differentiated[row - len(origins)]
    return origins[row] if row < len(origins) else Origin("", "projection of a loop", "")


def _assigned(r: ReducedModel) -> list[Row]:
    """Return the explicitly assigned expressions: solving for an unknown divides by its coefficient, which may vanish."""
    pairs = (*r.plan.assigned, *r.plan.observed)
    values = scalars(r.definitions[1]) if pairs else []
    return [Row(value, origin_of(r, e), EQUATION) for value, (_, e) in zip(values, pairs, strict=True)]


def _conditions(r: ReducedModel) -> list[Row]:
    """Return initial conditions, and conditions of events and switches."""
    flat = r.flat
    found = [Row(c.residual, c.origin, START) for c in flat.equations.initial]
    guards = flat.discontinuities.guards
    excess = _remaining(r, [g.excess for g in guards])
    return found + [Row(e, g.origin, EVENT) for e, g in zip(scalars(excess), guards, strict=True)]
