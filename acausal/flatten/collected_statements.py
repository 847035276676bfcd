"""Statements of all components of a model before simplification."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.component_equations import Equations, collect, collect_initial
from acausal.flatten.discontinuities import create_discretes, discrete_starts
from acausal.flatten.graph import Graph, build_graph
from acausal.flatten.instantiate import Instantiation
from acausal.flatten.origin import Origin, located_statements, method_origin, with_place
from acausal.flatten.part_constraints import add_constraints
from acausal.flatten.signal_connections import connected_values
from acausal.flatten.template_reuse import TemplateReuse
from acausal.flatten.variables import VariableArray, create_variables
from acausal.language import unit_rules
from acausal.language.component import Component, Connector
from acausal.language.expression import Equation, Expr, as_expr
from acausal.language.fields import Observed
from acausal.language.pending import PENDING, Pending
from acausal.language.value_checks import shown
from acausal.symbols import scalars, stacked, vec
from acausal.units import parse

ENERGIES = {"stored_energy": parse("J"), "dissipated_power": parse("W"), "supplied_power": parse("W")}
DERIVATIVES = "declared_derivatives"
MASS = parse("kg")


@dataclass
class CollectedStatements:
    """Instances, graph, variables, equations, declared derivatives and energies of a model."""

    build: Instantiation
    graph: Graph
    arrays: list[VariableArray]
    equations: Equations
    initial: Equations
    declared: list[tuple[Expr, Expr]]
    declared_by_parts: list[tuple[Expr, Expr]]
    energies: dict[str, Any]
    pending: Pending
    discretes: list[Expr]
    discrete_starts: list[ca.SX]
    variables: ca.SX
    index: dict[int, int]

    @property
    def kept(self) -> set[int]:
        """Variables with a derivative declared by a part; not eliminated, as an alias has no declared derivative."""
        return {self.index[s.element_hash()] for v, _ in self.declared_by_parts for s in scalars(v.sx)}


def collect_statements(
    model: Component, overrides: Mapping[str, Any] | None, free: Collection[str] = ()
) -> CollectedStatements:
    """Instantiate a model, connect it and collect the statements of its components."""
    pending = Pending()
    token = PENDING.set(pending)
    try:
        build = Instantiation(model, overrides, free)
        components = build.components
        graph = build_graph(components)
        declared_discretes = create_discretes(components)
        arrays = create_variables(components, graph.same)
        variables = stacked([vec(a.expr.sx) for a in arrays])
        index = {s.element_hash(): k for k, s in enumerate(scalars(variables))}
        pending.varying = pending.discrete | index.keys()
        discrete_values = discrete_starts(declared_discretes)
        pending.place(Origin.of(build.root, "a value of the class body"))
        build.give_inputs(connected_values(graph.wires))
        # Limit against endless loops: far more statements than a component needs, but reached within seconds.
        most = 10_000 + 10 * len(index)
        leads = [group[0] for group in graph.same]
        parts = [c for c in components if not isinstance(c, Connector)]
        reuse = TemplateReuse([*parts, *leads])
        equations = collect(components, graph, most, reuse, build.defaults)
        add_constraints(equations, index, variables, pending.derivatives)
        starts = collect_initial(components, most, reuse)
        declared, by_parts = ([p for c in group for p in _derivatives(c, reuse)] for group in (leads, parts))
        energies = {name: _total(name, components, reuse) for name in ENERGIES}
        pending.place(Origin.of(build.root))
        _check_observed(components)
        for symbol, table, raised in pending.tables:
            build.parameters.add_table(symbol, table, raised)
        discretes = [*(d.expr for d in declared_discretes), *(variable for variable, _ in pending.memories)]
        discrete_values += [start for _, start in pending.memories]
    finally:
        PENDING.reset(token)
    return CollectedStatements(
        build,
        graph,
        arrays,
        equations,
        starts,
        declared,
        by_parts,
        energies,
        pending,
        discretes,
        discrete_values,
        variables,
        index,
    )


def _derivatives(component: Component, reuse: TemplateReuse) -> Iterator[tuple[Expr, Expr]]:
    """Yield the variables with a derivative declared by a component, each with its derivative."""
    if getattr(type(component), DERIVATIVES) is not getattr(Component, DERIVATIVES):
        for pair, _ in reuse.statements(component, DERIVATIVES, tuple, lambda c: located_statements(c, DERIVATIVES)):
            yield pair


def _total(name: str, components: list[Component], reuse: TemplateReuse) -> ca.SX:
    """Return the sum of an energy or a power over all components."""
    total = as_expr(0.0)
    for component in components:
        if getattr(type(component), name) is not getattr(Component, name):
            for power, origin in reuse.statements(
                component, name, Expr, lambda c: [(_power(c, name), method_origin(c, name))]
            ):
                PENDING.get().place(origin)
                total = total + power
    return total.sx


def _power(component: Component, name: str) -> Expr:
    here = method_origin(component, name)
    value = with_place(getattr(component, name), here)
    if not isinstance(value, Expr | int | float | np.number) or isinstance(value, bool) or as_expr(value).shape:
        raise DeclarationError(f"{here}: {_no_power(name, value)}")
    value = as_expr(value)
    if value.sx.is_constant() and not value.sx.is_regular():
        raise DeclarationError(f"{here}: {name}() is {value.sx}; it must be finite.")
    declared = Expr(value.sx, ENERGIES[name], f"{name}()")
    if value.unit != ENERGIES[name] / MASS:  # the value of a unit mass
        with_place(lambda: unit_rules.common(declared, value, "its value"), here)
    return Expr(value.sx)


def _no_power(name: str, value: Any) -> str:
    """Return the message for an invalid value of an energy or a power."""
    unit = f"one scalar in {'J' if name == 'stored_energy' else 'W'}"
    if value is None:
        return f"{name}() returns nothing; write `return` before {unit}."
    if isinstance(value, Iterator):
        return f"{name}() must return {unit}; write `return`, not `yield`."
    if isinstance(value, Expr | np.ndarray | list | tuple):
        return f"{name}() must return {unit}, not {len(value)} values; a sum over entries is dot(a, b) or sum(...)."
    what = f"a method; call it, self.{value.__name__}()" if callable(value) else shown(value)
    return f"{name}() must return {unit}, not {'an equation' if isinstance(value, Equation) else what}."


def _check_observed(components: list[Component]) -> None:
    """Raise UnitsError for observed quantities with contradictory units, once for each class.

    Only classes in the file of the model's class are checked, as those of libraries may be expensive to evaluate. Other
    errors are reported when the quantity is read.
    """
    home = type(components[0]).__module__
    own = {type(c): c for c in reversed(components) if type(c).__module__ == home}
    token = PENDING.set(Pending())  # their requests are not part of the model
    try:
        for component in own.values():
            for name, declared in component.fields.items():
                if isinstance(declared, Observed):
                    with suppress(DeclarationError):
                        with_place(partial(getattr, component, name), Origin.of(component, f"{name}()"))
    finally:
        PENDING.reset(token)
