"""Closed loops of a flat model, and their redundant equations."""

from __future__ import annotations

from typing import Any

import casadi as ca

from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.component_equations import Closure
from acausal.flatten.flat_model import FlatClosure, FlatLoops, Loop
from acausal.flatten.linear_values import Linear
from acausal.flatten.spanning_tree import Cut
from acausal.language import fields as f
from acausal.symbols import scalars


def loops_of(
    raw: CollectedStatements,
    redundant: set[int],
    vanishing: set[int],
    values: list[Linear],
    rows: list[int],
    residuals: ca.SX,
    substitutes: dict[int, int],
    rates: set[int],
) -> FlatLoops:
    """Return the loops of a model and their closures.

    Parameters
    ----------
    raw : CollectedStatements
        Statements of the components.
    redundant : set of int
        Redundant residuals.
    vanishing : set of int
        Residuals that hold as unknowns stay 0; they constrain the other unknowns no more than redundant ones.
    values : list of Linear
        Value of each unknown.
    rows : list of int
        Residuals that remain.
    residuals : casadi.SX
        All residuals in remaining unknowns.
    substitutes : dict of int to int
        Residual of a closure -> row of the flow that works on it.
    rates : set of int
        Hashes of the unknowns without a derivative, or whose derivative an equation states; an equation of a part that
        contains one is not a constraint.
    """
    place = {r: n for n, r in enumerate(rows)}
    entries = scalars(residuals)
    cuts = raw.graph.cuts
    number = {id(cut): k for k, cut in enumerate(cuts)}
    closures = tuple(
        FlatClosure(place[c.row], entries[substitutes[c.row]], number.get(id(c.cut), -1), c.statement)
        for c in raw.equations.closures
        if c.row in place
        and (c.cut is not None or rates.isdisjoint(s.element_hash() for s in ca.symvar(entries[c.row])))
    )
    flows = [(name, a.declared.flow) for a in raw.arrays for name in a.names]
    own: list[list[Closure]] = [[] for _ in cuts]
    for c in raw.equations.closures:
        if c.cut is not None:
            own[number[id(c.cut)]].append(c)
    origins = raw.equations.scalar_origins()
    return FlatLoops(
        tuple(_loop(raw, redundant, vanishing, values, flows, *both) for both in zip(cuts, own, strict=True)),
        closures,
        tuple(origins[c.row] for c in raw.equations.closures if c.cut is None and c.row in redundant),
    )


def _loop(
    raw: CollectedStatements,
    redundant: set[int],
    vanishing: set[int],
    values: list[Linear],
    flows: list[tuple[str, bool]],
    cut: Cut,
    own: list[Closure],
) -> Loop:
    dropped = [c for c in own if c.row in redundant]
    found = sorted({raw.index.get(s.element_hash(), -1) for c in dropped for s in ca.symvar(c.dual)})
    undetermined = tuple(flows[k][0] for k in found if k >= 0 and flows[k][1] and values[k] == (0.0, ()))
    parts = tuple(part._path for part in cut.loop if _has_states(part))
    ends = cut.statement
    kind = ends.a.loop_kind(undetermined)
    surplus = len(dropped) + sum(c.row in vanishing for c in own)
    return Loop(ends.a._path, ends.b._path, cut.where, parts, len(own), surplus, undetermined, kind)


def _has_states(part: Any) -> bool:
    """Return whether a component has variables that are preferred as states."""
    return any(isinstance(d, f.Variable) and d.select > 0 for d in part.fields.values())
