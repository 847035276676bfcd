"""Constraints that parts state, and the reactions that enforce them.

A component that states one equation in its over-determined potentials alone leaves one of its unknowns to the rest of the
model: the reaction. Such an equation enters the mechanism of those that close loops: where it follows from others, its
reaction is undetermined.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca

from acausal.flatten.collect import Closure, Equations
from acausal.flatten.tree import walk
from acausal.language import fields as f
from acausal.language.component import Component, Connector
from acausal.symbols import dense, scalars, stacked, vec


def add_constraints(
    equations: Equations, index: dict[int, int], variables: ca.SX, derivatives: Sequence[tuple[ca.SX, ca.SX]]
) -> None:
    """Append the constraints of parts to the closures.

    Parameters
    ----------
    equations : Equations
        Those of the whole model; `closures` is extended.
    index : dict of int to int
        Hash of each variable -> its place.
    variables : casadi.SX
        All variables, a column.
    derivatives : sequence of (casadi.SX, casadi.SX)
        Placeholders of derivatives, and what is differentiated.
    """
    owners = [(c, statements) for c, statements in equations.owned if any(map(_is_given, c._ports))]
    if not owners:
        return
    first, rows = [0], _columns(stacked(equations.residuals), variables, derivatives)
    for residual in equations.residuals:
        first.append(first[-1] + residual.numel())
    entries, statement_of = scalars(variables), [k for k, r in enumerate(equations.residuals) for _ in range(r.numel())]
    for component, statements in owners:
        unknowns = _unknowns(component, index)
        own = {row: rows[row] for row in range(first[statements.start], first[statements.stop])}
        stated, reactions = _left_over(own, unknowns)
        if 0 < len(stated) <= len(reactions):
            found = zip(stated, reactions, strict=False)
            equations.closures += [Closure(row, entries[k], None, statement_of[row]) for row, k in found]


def _is_given(port: Any) -> bool:
    """True if the rest of the model gives the over-determined record of a port."""
    if not isinstance(port, Connector) or type(port).residual is Connector.residual:
        return False
    return not port._is_root and not any(p._owner is port._owner for p in port._parents)


@dataclass(frozen=True)
class _Unknowns:
    """Places of variables: what a component must determine, in the order in which its equations do so, and what it is given.

    `records` are over-determined potentials that are given, `free` the unknowns that may be reactions.
    """

    own: list[int]
    records: set[int]
    free: set[int]


def _unknowns(component: Component, index: dict[int, int]) -> _Unknowns:
    flows, potentials, records = list[int](), list[int](), set[int]()
    for port in component._ports:
        given, root = _is_given(port), type(port).residual is not Connector.residual
        for member in walk(port):
            for name, declared in member.fields.items():
                places = _places(vars(member).get(name), index) if isinstance(declared, f.Variable) else ()
                if declared.flow if isinstance(declared, f.Variable) else False:
                    flows += places
                elif given:
                    records.update(places)
                elif root:
                    potentials += places
    variables = [
        place
        for name, declared in component.fields.items()
        if isinstance(declared, f.Variable) and declared.causality not in ("input", "discrete")
        for place in _places(vars(component).get(name), index)
    ]
    return _Unknowns([*potentials, *flows, *variables], records, {*flows, *variables})


def _places(value: Any, index: dict[int, int]) -> Iterator[int]:
    """Places of the entries of a variable."""
    found = (index.get(s.element_hash()) for s in scalars(value.sx)) if value is not None else ()
    return (k for k in found if k is not None)


def _columns(
    residuals: ca.SX, variables: ca.SX, derivatives: Sequence[tuple[ca.SX, ca.SX]]
) -> list[dict[int, bool]]:
    """Variables in each residual, and whether they occur there by themselves, not by a derivative alone."""
    n = variables.numel()
    placeholders = stacked([p for p, _ in derivatives])
    inside = _incidence(stacked([vec(dense(e)) for _, e in derivatives]), variables) if derivatives else []
    found = list[dict[int, bool]]()
    for row in _incidence(residuals, ca.vertcat(variables, placeholders)):
        columns = {v: False for k in row if k >= n for v in inside[k - n]}
        found.append(columns | {k: True for k in row if k < n})
    return found


def _incidence(column: ca.SX, symbols: ca.SX) -> list[list[int]]:
    rows: list[list[int]] = [[] for _ in range(column.numel())]
    pattern = ca.jacobian_sparsity(column, symbols)  # type: ignore[attr-defined]
    for i, k in zip(*pattern.get_triplet(), strict=True):
        rows[i].append(k)
    return rows


def _left_over(rows: dict[int, dict[int, bool]], unknowns: _Unknowns) -> tuple[list[int], list[int]]:
    """Equations of a component that determine none of its unknowns, and unknowns that none of them determines.

    Equations without given records come first, so that those that are left constrain these; variables of the component
    itself come last among the unknowns, so that they are left, not the flows which they define.
    """
    own = set(unknowns.own)
    moving = {k for columns in rows.values() for k, itself in columns.items() if not itself}
    order = sorted(rows, key=lambda row: not unknowns.records.isdisjoint(rows[row]))
    used = _matched(order, {row: own.intersection(rows[row]) for row in order})
    stated = [row for row in order if row not in used]
    if not stated or any(unknowns.records.isdisjoint(rows[row]) for row in stated):
        return [], []
    holders: dict[int, list[int]] = {k: [] for k in unknowns.own}
    for row in used:
        for k in own.intersection(rows[row]):
            holders[k].append(row)
    determined = _matched(unknowns.own, holders)
    left = [k for k in reversed(unknowns.own) if k in unknowns.free - moving and k not in determined]
    return sorted(stated), sorted(left, key=lambda k: unknowns.own.index(k))


def _matched(order: Iterable[int], neighbours: dict[int, Any]) -> set[int]:
    """Members of a bipartite graph's one side, the first ones first, that can be matched together (Kuhn 1955)."""
    of: dict[int, int] = {}

    def augment(member: int, seen: set[int]) -> bool:
        for other in neighbours[member]:
            if other not in seen:
                seen.add(other)
                if other not in of or augment(of[other], seen):
                    of[other] = member
                    return True
        return False

    return {member for member in order if augment(member, set())}
