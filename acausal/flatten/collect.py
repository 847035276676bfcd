"""Collect the equations of all components, each entry with its origin, and form the derivatives they request."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.graph import Balance, Graph
from acausal.flatten.origin import Origin, entries, method_origin, stated, with_place
from acausal.flatten.spanning_tree import Cut
from acausal.flatten.tree import join, walk
from acausal.language import fields as f
from acausal.language.component import Component, Connector
from acausal.language.events import When
from acausal.language.expression import Equation, Expr, as_expr, equation
from acausal.language.functions import PENDING
from acausal.language.homes import error_of, misplaced
from acausal.symbols import dense, scalars, vec


@dataclass(frozen=True)
class Closure:
    """A scalar residual that closes a loop.

    `dual` is the flow that does work on it: undetermined, and taken as 0, where the residual is redundant.
    """

    row: int
    dual: ca.SX
    cut: Cut
    statement: int


@dataclass
class Equations:
    """Scalar residuals with their origins; `sides` keeps both sides of each array equation."""

    residuals: list[ca.SX]
    sides: list[tuple[ca.SX, ca.SX]]
    origins: list[Origin]
    closures: list[Closure] = field(default_factory=list)

    def add(self, statement: Equation, origin: Origin) -> None:
        """Append an equation."""
        self.residuals.append(dense(vec(statement.lhs.sx - statement.rhs.sx)))
        self.sides.append((statement.lhs.sx, statement.rhs.sx))
        self.origins.append(origin)

    def scalar_origins(self) -> list[Origin]:
        """Return the origin of each scalar residual."""
        return [o for o, r in zip(self.origins, self.residuals, strict=True) for _ in range(r.numel())]


def collect(components: list[Component], graph: Graph, most: int) -> Equations:
    """Return the equations of all components, at most `most` of each, of connection sets, roots and cuts."""
    found = Equations([], [], [])
    for component in components:
        _run(component, "equations", found, most)
        for name, value in component._values.items():
            declared = component.fields[name]
            if isinstance(declared, f.Variable) and not isinstance(value, f.InitialValue):
                origin = Origin(component._path, type(component).__name__, component._origin, f"{name}=...")
                with_place(
                    lambda n=name, v=value, c=component, o=origin: found.add(equation(getattr(c, n), v), o), origin
                )
                PENDING.get().place(origin)
    for connector in graph.roots:
        _run(connector, "root_equations", found, most)
    _close(graph, found)
    for balance in graph.balances:
        _balance(balance, found)
    return found


def collect_initial(components: list[Component], most: int) -> Equations:
    """Return the initial equations of all components, at most `most` of each."""
    found = Equations([], [], [])
    for component in components:
        _run(component, "initial_equations", found, most)
    return found


def _close(graph: Graph, found: Equations) -> None:
    """Add the residuals of all cuts, and the flows that do work on them."""
    sides = {id(c): group for group in graph.same for c in group}
    balances: dict[int, list[Balance]] = {}
    for balance in graph.balances if graph.cuts else ():
        for connector, _ in balance:
            balances.setdefault(id(connector), []).append(balance)
    row = sum(r.numel() for r in found.residuals) if graph.cuts else 0
    for cut in graph.cuts:
        a, b = cut.statement.a, cut.statement.b
        balance = next(s for s in balances[id(a)] if any(c is b for c, _ in s))
        sent = _sent(a, balance, sides[id(a)])
        origin = Origin("", f"connection of {a._path} and {b._path}", cut.where, "closing a loop")
        for (statement, dual), _ in entries(sent.residual(b), method_origin(a, "residual"), "residual"):
            number = len(found.sides)
            found.add(statement, origin)
            for k, entry in enumerate(scalars(as_expr(dual).sx)):
                found.closures.append(Closure(row + k, entry, cut, number))
            row += found.residuals[-1].numel()


def _sent(a: Connector, balance: Balance, side: tuple[Connector, ...]) -> Connector:
    """Return a connector with the flows that its side of a connection sends across."""
    sent = copy(a)
    for name, declared in a.fields.items():
        if isinstance(declared, f.Variable) and declared.flow:
            flows = [getattr(c, name) * sign for c, sign in balance if c in side]
            vars(sent)[name] = sum(flows[1:], flows[0])
    return sent


def _balance(balance: Balance, found: Equations) -> None:
    first, outside = balance[0]
    if len(balance) == 1 and (outside < 0 or first._owner is None):
        return  # nothing inside uses this port of a composite, or the component itself does
    text = " + ".join(c._path for c, _ in balance) if len(balance) > 1 else f"{first._path} is not connected"
    for same in zip(*(walk(c) for c, _ in balance), strict=True):
        for name, declared in same[0].fields.items():
            if isinstance(declared, f.Variable) and declared.flow:
                flows = [getattr(c, name).sx * sign for c, (_, sign) in zip(same, balance, strict=True)]
                total: Any = sum(flows[1:], flows[0])
                zero = Expr(ca.SX.zeros(*total.shape))
                origin = Origin(join(same[0]._path, name), type(same[0]).__name__, "flows of a connection", text)
                found.add(Equation(Expr(total), zero), origin)


def _run(component: Component, method: str, found: Equations, most: int) -> None:
    for statement, origin in stated(component, method, most):
        PENDING.get().place(origin)
        if isinstance(statement, When) and method == "equations":
            PENDING.get().whens.append((statement, origin))
            continue
        if not isinstance(statement, Equation):
            raise error_of(statement)(f"{origin}: {misplaced(statement, method)}")
        residual = vec(statement.lhs.sx - statement.rhs.sx)
        if residual.is_constant():
            value = np.array(ca.evalf(residual)).ravel()
            if np.any(value != 0):
                raise DeclarationError(f"{origin}: this equation can never hold; its sides differ by {value.tolist()}.")
            if not (statement.lhs.sx.is_constant() and statement.rhs.sx.is_constant()):
                raise DeclarationError(f"{origin}: this equation is empty: both sides are the same expression.")
        found.add(statement, origin)
