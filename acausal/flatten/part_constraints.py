"""Constraints stated by parts, and the flows that work on them.

A component with an equation in its over-determined potentials alone leaves one of its unknowns, the reaction, to the
rest of the model. Such a constraint is treated as one that closes a loop: if it is redundant, its reaction is
undetermined. For c = C v in the velocities v of the ports, reactions that do no work on admissible motions are flows
f = C' m; C f measures them, whatever variables the component uses.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

import casadi as ca
import numpy as np

from acausal.flatten.component_equations import Closure, Equations
from acausal.flatten.component_tree import walk
from acausal.language import fields as f
from acausal.language.component import Component, Connector
from acausal.language.expression import as_expr
from acausal.symbols import dense, scalars, stacked, vec


def add_constraints(
    equations: Equations, index: Mapping[int, int], variables: ca.SX, derivatives: Sequence[tuple[ca.SX, ca.SX]]
) -> None:
    """Append the constraints stated by parts to the closures.

    Parameters
    ----------
    equations : Equations
        Equations of the whole model; `closures` is extended.
    index : mapping of int to int
        Hash of each variable -> its position.
    variables : casadi.SX
        All variables, a column.
    derivatives : sequence of (casadi.SX, casadi.SX)
        Placeholders of derivatives, and the differentiated expressions.
    """
    owners = [(c, statements) for c, statements in equations.owned if any(map(_is_prescribed, c._ports))]
    if not owners:
        return
    column, first = stacked(equations.residuals), [0]
    for residual in equations.residuals:
        first.append(first[-1] + residual.numel())
    statement_of = [k for k, r in enumerate(equations.residuals) for _ in range(r.numel())]
    columns, residuals = _columns(column, variables, derivatives), scalars(column)
    for component, statements in owners:
        rows = range(first[statements.start], first[statements.stop])
        own, given = _unknowns(component, index)
        stated, reactions = _constraints_and_reactions({row: columns[row] for row in rows}, own, given)
        duals = _constraint_flows([residuals[row] for row in stated], component, [variables[k] for k in reactions])
        for row, dual in zip(stated, duals, strict=True):
            if not dual.is_zero():
                equations.closures.append(Closure(row, dual, None, statement_of[row]))


def rates(
    free: ca.SX, declared: Sequence[tuple[Any, Any]], index: Mapping[int, int], followed: Collection[int]
) -> set[int]:
    """Return the hashes of unknowns without derivative, or with a derivative declared by a root in differentiated
    unknowns.

    Parameters
    ----------
    free : casadi.SX
        Unknowns without a derivative, a column.
    declared : sequence of (Expr, Expr)
        Variables with their declared derivatives.
    index : mapping of int to int
        Hash of each variable -> its position.
    followed : collection of int
        Positions of variables whose declared derivative is used to differentiate, and not integrated.
    """
    found = {s.element_hash() for s in scalars(free)}
    pairs = [(s, e) for v, d in declared for s, e in zip(scalars(v.sx), scalars(d.sx), strict=True)]
    known = {s.element_hash() for s, _ in pairs}
    for symbol, derivative in pairs:
        inside = {s.element_hash() for s in ca.symvar(derivative)}
        if index[symbol.element_hash()] not in followed and inside <= known:
            found.add(symbol.element_hash())
    return found


def _is_prescribed(port: Any) -> bool:
    """Return whether the rest of the model determines the over-determined record of a port."""
    return _has_record(port) and not port._is_root and not any(p._owner is port._owner for p in port._parents)


def _has_record(port: Any) -> bool:
    return isinstance(port, Connector) and type(port).residual is not Connector.residual


def _unknowns(component: Component, index: Mapping[int, int]) -> tuple[list[int], set[int]]:
    """Return the positions of the variables that a component determines, and of the prescribed potentials."""
    own, given = dict[int, None](), dict[int, None]()
    for port in component._ports:
        for member in walk(port):
            for name, declared in member.fields.items():
                if isinstance(declared, f.Variable):
                    of = given if _is_prescribed(port) else own if _has_record(port) else dict[int, None]()
                    (own if declared.flow else of).update(dict.fromkeys(_places(vars(member).get(name), index)))
    for name, declared in component.fields.items():
        if isinstance(declared, f.Variable) and declared.causality not in ("input", "discrete"):
            own.update(dict.fromkeys(_places(vars(component).get(name), index)))
    return list(own), set(given)


def _places(value: Any, index: Mapping[int, int]) -> Iterator[int]:
    """Yield the positions of the entries of a variable."""
    found = (index.get(s.element_hash()) for s in scalars(value.sx)) if value is not None else ()
    return (k for k in found if k is not None)


def _columns(residuals: ca.SX, variables: ca.SX, derivatives: Sequence[tuple[ca.SX, ca.SX]]) -> list[set[int]]:
    """Return the variables in each residual, including those that it contains in derivatives."""
    n, inside = variables.numel(), list[set[int]]()
    if derivatives:
        inside = _incidence(stacked([vec(dense(e)) for _, e in derivatives]), variables)
    found = _incidence(residuals, stacked([variables, *[p for p, _ in derivatives]]))
    return [{v for k in row for v in ((k,) if k < n else inside[k - n])} for row in found]


def _incidence(column: ca.SX, symbols: ca.SX) -> list[set[int]]:
    rows: list[set[int]] = [set() for _ in range(column.numel())]
    pattern = ca.jacobian_sparsity(column, symbols)  # type: ignore[attr-defined]
    for i, k in zip(*pattern.get_triplet(), strict=True):
        rows[i].add(k)
    return rows


def _constraints_and_reactions(
    rows: Mapping[int, set[int]], own: list[int], given: set[int]
) -> tuple[list[int], list[int]]:
    """Return the equations of a component that determine none of its unknowns, and as many undetermined unknowns.

    Equations without prescribed potentials are matched first, so that the remaining ones constrain these potentials.
    """
    order = sorted(rows, key=lambda row: not given.isdisjoint(rows[row]))
    used = _matched(order, {row: rows[row].intersection(own) for row in order})
    stated = sorted(set(rows).difference(used))
    if not stated or any(given.isdisjoint(rows[row]) for row in stated) or len(stated) > len(own) - len(used):
        return [], []
    determined = _matched(own, {k: {row for row in used if k in rows[row]} for k in own})
    return stated, [k for k in own if k not in determined]


def _matched(order: Iterable[int], neighbours: Mapping[int, set[int]]) -> set[int]:
    """Return the members of one side of a bipartite graph that can be matched, in order of priority (Kuhn 1955)."""
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


def _constraint_flows(constraints: list[ca.SX], component: Component, reactions: list[ca.SX]) -> list[ca.SX]:
    """Return the flow that works on each constraint; for a constraint of positions, on its time derivative.

    For dependent constraints of one component, the flows of its ports do not determine the share of each; there the
    reactions are used, in the order of the constraints.
    """
    if not constraints:
        return []
    ports = [port for port in component._ports if _is_prescribed(port)]
    declared = [pair for port in ports for pair in port.declared_derivatives()]
    pairs = [pair for port in ports for pair in port.power()]
    rates, flows = (stacked([vec(as_expr(pair[k]).sx) for pair in pairs]) for k in (0, 1))
    moving, moved = (stacked([vec(as_expr(pair[k]).sx) for pair in declared]) for k in (0, 1))
    own = [c if ca.depends_on(c, rates) else ca.jtimes(c, moving, moved) for c in constraints]
    J = ca.jacobian(stacked(own), rates)
    if len(reactions) == len(constraints) and _rank(J) < len(constraints):
        return reactions
    return scalars(ca.densify(ca.mtimes(J, flows)))


def _rank(J: ca.SX) -> int:
    """Return the generic rank of a matrix, at random values of its symbols."""
    symbols = stacked(ca.symvar(J))
    values = np.random.default_rng(0).uniform(0.5, 1.5, symbols.numel())
    found = np.array(ca.Function("J", [symbols], [ca.densify(J)])(values))
    return int(np.linalg.matrix_rank(found)) if np.all(np.isfinite(found)) else J.shape[0]
