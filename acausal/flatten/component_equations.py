"""Collection of the equations of all components, each with its origin."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field
from functools import reduce
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join, walk
from acausal.flatten.field_values import DeferredInput
from acausal.flatten.graph import Balance, Graph
from acausal.flatten.origin import Origin, entries, located_statements, method_origin, with_place
from acausal.flatten.spanning_tree import Cut
from acausal.flatten.template_reuse import TemplateReuse
from acausal.language import fields as f
from acausal.language.component import Component, Connector
from acausal.language.expression import Equation, Expr, as_expr, equation
from acausal.language.pending import PENDING
from acausal.language.quantities import plain
from acausal.language.set_valued_statement import SetValued
from acausal.language.soft import Soft
from acausal.language.statement_kinds import error_of, misplaced_message
from acausal.language.when_statements import When
from acausal.symbols import combined, dense, scalars, vec


@dataclass(frozen=True)
class Closure:
    """A scalar residual that closes a loop, or, with `cut` None, a constraint of a part.

    `dual` is the flow that does work on it; it is undetermined, and set to 0, if the residual is redundant.
    """

    row: int
    dual: ca.SX
    cut: Cut | None
    statement: int


@dataclass
class Equations:
    """Scalar residuals with their origins.

    `sides` contains both sides of each array equation; `of_roots`, `owned` and `soft` are the numbers of the array
    equations of roots, of each component, and of soft initial equations.
    """

    residuals: list[ca.SX]
    sides: list[tuple[ca.SX, ca.SX]]
    origins: list[Origin]
    closures: list[Closure] = field(default_factory=list)
    of_roots: range = range(0)
    owned: list[tuple[Component, range]] = field(default_factory=list)
    soft: set[int] = field(default_factory=set)

    def add(self, statement: Equation, origin: Origin) -> ca.SX:
        """Append an equation; return its residual."""
        if isinstance(statement, Soft):
            self.soft.add(len(self.sides))
        self.residuals.append(dense(vec(combined(statement.lhs.sx, "-", statement.rhs.sx))))
        self.sides.append((statement.lhs.sx, statement.rhs.sx))
        self.origins.append(origin)
        return self.residuals[-1]

    def scalar_origins(self) -> list[Origin]:
        """Return the origin of each scalar residual."""
        return [o for o, r in zip(self.origins, self.residuals, strict=True) for _ in range(r.numel())]

    def scalar_soft(self) -> list[bool]:
        """Return whether closed loops override each scalar residual."""
        return [k in self.soft for k, r in enumerate(self.residuals) for _ in range(r.numel())]


def collect(
    components: list[Component], graph: Graph, most: int, reuse: TemplateReuse, defaults: list[DeferredInput]
) -> Equations:
    """Return the equations of all components, at most `most` of each, of connection sets, roots and cuts."""
    found = Equations([], [], [])
    for component in components:
        start = len(found.sides)
        _run(component, "equations", found, most, reuse)
        found.owned.append((component, range(start, len(found.sides))))
        for name, value in component._values.items():
            declared = component.fields[name]
            if isinstance(declared, f.Variable) and not isinstance(value, f.InitialValue):
                origin = Origin(component._path, type(component).__name__, component._origin, f"{name}=...")
                with_place(
                    lambda n=name, v=value, c=component, o=origin: found.add(_input_equation(c, n, v), o), origin
                )
                PENDING.get().place(origin)
    _add_defaults(found, defaults)
    first = len(found.sides)
    for connector in graph.roots:
        _run(connector, "root_equations", found, most, reuse)
    found.of_roots = range(first, len(found.sides))
    _close(graph, found)
    stated = _alone(found, slice(0, 1))
    for balance in graph.balances:
        _balance(balance, found, stated)
    return found


def _add_defaults(found: Equations, defaults: list[DeferredInput]) -> None:
    """Add default values of inputs, unless a containing component states the input alone on a side of an equation."""
    alone = _alone(found, slice(0, 2)) if defaults else {}
    for component, name, value, origin in defaults:
        own = getattr(component, name)
        if not any(_is_stated(s, component, alone) for s in scalars(own.sx)):
            with_place(lambda n=name, v=value, c=component, o=origin: found.add(_input_equation(c, n, v()), o), origin)
            PENDING.get().place(origin)


def _alone(found: Equations, sides: slice) -> dict[int, list[str]]:
    """Return, by symbol, the paths of components that state it alone on a side of an equation; 0 is left, 1 right."""
    alone: dict[int, list[str]] = {}
    for component, rows in found.owned:
        for side in (side for both in found.sides[rows.start : rows.stop] for side in both[sides]):
            for s in scalars(side):
                if s.is_symbolic():
                    alone.setdefault(s.element_hash(), []).append(component._path)
    return alone


def _is_stated(symbol: ca.SX, component: Component, alone: dict[int, list[str]]) -> bool:
    """Return whether a component that contains `component` states a symbol of it, alone on a side of an equation."""
    paths = alone.get(symbol.element_hash(), ())
    return any(path == "" or component._path.startswith(f"{path}.") for path in paths)


def _input_equation(component: Component, name: str, value: Any) -> Any:
    """Return the equation of an input of a part and its value."""
    own = getattr(component, name)
    return equation(own, plain(value, own.unit, f"`{name}`"))


def collect_initial(components: list[Component], most: int, reuse: TemplateReuse) -> Equations:
    """Return the initial equations of all components, at most `most` of each."""
    found = Equations([], [], [])
    for component in components:
        _run(component, "initial_equations", found, most, reuse)
    return found


def _close(graph: Graph, found: Equations) -> None:
    """Add the residuals of all cuts; the flow that works on each is the sum over one side of its connection.

    The side with fewer flows is used.
    """
    groups = {id(c): group for group in graph.same for c in group}
    balances_at_cuts = _balances_at_cuts(graph)
    within: dict[int, list[Cut]] = {}
    for cut, balances in zip(graph.cuts, balances_at_cuts, strict=True):
        for balance in balances:
            within.setdefault(id(balance), []).append(cut)
    row = sum(r.numel() for r in found.residuals) if graph.cuts else 0
    for cut, (balance, *_) in zip(graph.cuts, balances_at_cuts, strict=True):
        a, b = cut.statement.a, cut.statement.b
        others = [(c.statement.a, c.statement.b) for c in within[id(balance)] if c is not cut]
        ways = [*others, *((second, first) for first, second in others)]
        sides = ((_side(a, b, ways, groups), 1), (_side(b, a, ways, groups), -1))
        across = min(([(c, sign * sense) for c, sign in balance if id(c) in side] for side, sense in sides), key=len)
        sent = _sum_of_side(a, across)
        origin = Origin("", f"connection of {a._path} and {b._path}", cut.where, "closing a loop")
        for (statement, dual), _ in entries(sent.residual(b), method_origin(a, "residual"), "residual"):
            number = len(found.sides)
            found.add(statement, origin)
            for k, entry in enumerate(scalars(as_expr(dual).sx)):
                found.closures.append(Closure(row + k, entry, cut, number))
            row += found.residuals[-1].numel()


def _balances_at_cuts(graph: Graph) -> list[list[Balance]]:
    """Return, for each cut, the flow balances that contain both of its ends."""
    of: dict[int, list[Balance]] = {}
    for balance in graph.balances if graph.cuts else ():
        for connector, _ in balance:
            of.setdefault(id(connector), []).append(balance)
    ends = [(cut.statement.a, cut.statement.b) for cut in graph.cuts]
    return [[balance for balance in of[id(a)] if any(c is b for c, _ in balance)] for a, b in ends]


def _sum_of_side(a: Connector, across: list[tuple[Connector, int]]) -> Connector:
    """Return a copy of a connector with the sum of the flows of its side of a connection."""
    sent = copy(a)
    for name, declared in a.fields.items():
        if isinstance(declared, f.Variable) and declared.flow:
            flows = [getattr(c, name) * sign for c, sign in across]
            vars(sent)[name] = sum(flows[1:], flows[0])
    return sent


def _side(
    end: Connector, beyond: Connector, ways: list[tuple[Connector, Connector]], groups: dict[int, tuple[Connector, ...]]
) -> set[int]:
    """Return the identities of the connectors on one side of a cut.

    The other cuts of the connection set, `ways`, count as connected; connectors of a group share their potentials.
    """
    side, other = list(groups[id(end)]), groups[id(beyond)]
    for connector in side:
        for near, far in ways:
            if near is connector and far not in (*side, *other):
                side += groups[id(far)]
    return {id(c) for c in side}


def _balance(balance: Balance, found: Equations, stated: dict[int, list[str]]) -> None:
    """Add the flow balance of a connection set; flows of an unconnected connector may be stated outside instead."""
    first, outside = balance[0]
    if len(balance) == 1 and (outside < 0 or first._owner is None):
        return  # an outside port without inside connection, or a port of the whole model
    text = " + ".join(c._path for c, _ in balance) if len(balance) > 1 else f"{first._path} is not connected"
    for same in zip(*(walk(c) for c, _ in balance), strict=True):
        for name, declared in same[0].fields.items():
            if isinstance(declared, f.Variable) and declared.flow:
                flows = [(getattr(c, name).sx, sign) for c, (_, sign) in zip(same, balance, strict=True)]
                if len(balance) == 1 and all(_is_stated(s, first._owner, stated) for s in scalars(flows[0][0])):
                    continue
                total = reduce(lambda a, b: combined(a, "+", b), [sx if sign > 0 else -sx for sx, sign in flows])
                zero = Expr(ca.SX.zeros(*total.shape))
                origin = Origin(join(same[0]._path, name), type(same[0]).__name__, "flows of a connection", text)
                found.add(Equation(Expr(total), zero), origin)


def _run(component: Component, method: str, found: Equations, most: int, reuse: TemplateReuse) -> None:
    for statement, origin in reuse.statements(
        component, method, Equation, lambda c: located_statements(c, method, most)
    ):
        PENDING.get().place(origin)
        if isinstance(statement, When) and method == "equations":
            PENDING.get().whens.append((statement, origin))
            continue
        if isinstance(statement, SetValued) and method == "equations":
            PENDING.get().laws.append((statement, origin))
            continue
        if not isinstance(statement, Equation):
            raise error_of(statement)(f"{origin}: {misplaced_message(statement, method)}")
        residual = found.add(statement, origin)
        if residual.is_constant():
            value = np.array(ca.evalf(residual)).ravel()
            if np.any(value != 0):
                raise DeclarationError(f"{origin}: this equation can never hold; its sides differ by {value.tolist()}.")
            if not (statement.lhs.sx.is_constant() and statement.rhs.sx.is_constant()):
                raise DeclarationError(f"{origin}: this equation is empty: both sides are the same expression.")
