"""Creation of the symbols of all variables; connected potentials share one symbol."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import isfinite
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join, walk
from acausal.flatten.field_values import shape_of, unit_of
from acausal.flatten.numeric import misshapen
from acausal.flatten.origin import value_origin, with_place
from acausal.language import fields as f
from acausal.language import unit_rules
from acausal.language.component import Component, Connector
from acausal.language.expression import Expr, as_expr
from acausal.language.quantities import plain
from acausal.symbols import combined, scalars, vec
from acausal.units import Dimension


@dataclass(frozen=True)
class VariableArray:
    """A declared variable with its symbols and attributes, entries in column-major order.

    An entry is `fixed` if its start value is an initial condition, and `guessed` if the value is given with the
    component.
    """

    path: str
    expr: Expr
    declared: f.Variable
    owner: Component
    start: Expr
    fixed: tuple[bool, ...]
    guessed: tuple[bool, ...]
    nominal: Expr
    sized: bool

    @property
    def units(self) -> list[Dimension | None]:
        """Unit of each entry, None if unknown."""
        n, unit = self.expr.sx.numel(), self.expr.unit
        return list(unit) * (n // max(1, len(unit))) if isinstance(unit, tuple) else [unit] * n

    @property
    def start_line(self) -> str:
        """File and line of the start value: of the component, or of its class."""
        is_given = self.path.rpartition(".")[2] in self.owner._values
        return self.owner._origin if is_given else self.declared.where

    def conditions(self) -> list[tuple[ca.SX, str]]:
        """Return the residual and the text of each fixed start value."""
        if not any(self.fixed):
            return []
        residuals, starts = scalars(vec(self.expr.sx - self.start.sx)), scalars(self.start.sx)
        entries = zip(self.fixed, residuals, self.names, starts, strict=True)
        return [(residual, f"{name} = {start}") for fixed, residual, name, start in entries if fixed]

    @cached_property
    def names(self) -> list[str]:
        """Names of the entries."""
        return entry_names(self.path, self.expr.shape)


def entry_names(path: str, shape: tuple[int, ...]) -> list[str]:
    """Return the names of the entries of an array, column by column."""
    return [f"{path}[{','.join(map(str, i[::-1]))}]" for i in np.ndindex(shape[::-1])] if shape else [path]


def create_variables(components: list[Component], same: list[tuple[Connector, ...]]) -> list[VariableArray]:
    """Create the symbols of all variables and set them as attributes of their components."""
    arrays: list[VariableArray] = []
    inside: set[int] = set()
    for group in same:
        _connectors(group, any(c._is_root for c in group), arrays)
        inside.update(id(member) for connector in group for member in _members(connector))
    for component in components:
        if id(component) not in inside:
            for name, declared in component.fields.items():
                if isinstance(declared, f.Variable) and name not in vars(component):
                    vars(component)[name] = _create(component, name, declared, arrays)
    return arrays


def _connectors(group: tuple[Connector, ...], is_root: bool, arrays: list[VariableArray]) -> None:
    """Create common potentials of connected connectors, and separate flows."""
    for others in zip(*(_members(c) for c in group), strict=True):
        lead = others[0]
        for name, declared in lead.fields.items():
            if not isinstance(declared, f.Variable) or (declared.root and not is_root):
                continue
            if declared.flow:
                for connector in others:
                    vars(connector)[name] = _create(connector, name, declared, arrays)
                continue
            given = next((c for c in others if name in c._values), lead)
            shared = _create(given, name, declared, arrays)
            for connector in others:
                vars(connector)[name] = shared


def _members(connector: Component) -> list[Component]:
    """Return a connector and its records."""
    return list(walk(connector))


def _create(owner: Component, name: str, declared: f.Variable, arrays: list[VariableArray]) -> Expr:
    return with_place(lambda: _declare(owner, name, declared, arrays), value_origin(owner, name))


def _declare(owner: Component, name: str, declared: f.Variable, arrays: list[VariableArray]) -> Expr:
    path = join(owner._path, name)
    shape = shape_of(declared, owner)
    symbol = ca.SX.sym(path, *shape)
    expr = Expr(symbol, unit_of(declared, owner), path, shape)
    given = owner._values.get(name)
    of_class = f.InitialValue(f.evaluate(declared.start, owner), declared.fixed)
    start = given if isinstance(given, f.InitialValue) else of_class
    value, fixed, guessed = _entries(start, of_class, expr)
    nominal = declared.nominal(owner) if callable(declared.nominal) else declared.nominal
    nominal = start.nominal if start.nominal is not None else f.evaluate(nominal, owner)
    arrays.append(
        VariableArray(
            path,
            expr,
            declared,
            owner,
            _fill(value, shape, expr, "start"),
            fixed,
            guessed,
            _fill(1.0 if nominal is None else nominal, shape, expr, "nominal"),
            nominal is not None,
        )
    )
    return expr


def _entries(
    start: f.InitialValue, of_class: f.InitialValue, expr: Expr
) -> tuple[Any, tuple[bool, ...], tuple[bool, ...]]:
    """Return a start value, and for each entry whether it is fixed and whether it is given; None is the class value."""
    n, value = expr.sx.numel(), start.value
    if len(expr.shape) != 1 or not isinstance(value, list | tuple) or not any(map(_is_special, value)):
        return value, (start.fixed,) * n, (start is not of_class,) * n
    if len(value) != n:
        raise DeclarationError(misshapen(f"start of `{expr.name}`", value, (len(value),), expr.shape))
    otherwise = _fill(of_class.value, expr.shape, expr, "start")

    def of(k: int, entry: Any) -> f.InitialValue:
        if entry is None:
            return f.InitialValue(otherwise[k], of_class.fixed)
        return entry if isinstance(entry, f.InitialValue) else f.InitialValue(entry, start.fixed)

    entries = [of(k, entry) for k, entry in enumerate(value)]
    return [e.value for e in entries], tuple(e.fixed for e in entries), tuple(entry is not None for entry in value)


def _is_special(entry: Any) -> bool:
    """Return whether an entry of a start value is special: None, fixed(...) or guess(...)."""
    return entry is None or isinstance(entry, f.InitialValue)


@lru_cache(maxsize=1024)
def _filled(value: float, shape: tuple[int, ...]) -> Expr:
    given = as_expr(value)
    return Expr(combined(ca.SX.ones(*shape), "*", given.sx), shape=shape) if shape else given


def _fill(value: Any, shape: tuple[int, ...], variable: Expr, what: str) -> Expr:
    """Return the value as an expression of the given shape and unit; a number fills an array."""
    path = variable.name
    if callable(value):
        raise DeclarationError(f"{what} of `{path}` must be a value, not a function.")
    if isinstance(value, bool | np.bool_):
        raise DeclarationError(f"{what} of `{path}` is {value!r}; it must be a number.")
    value = plain(value, variable.unit, f"{what} of `{path}`")
    if type(value) is float and isfinite(value) and (what == "start" or value > 0):
        return _filled(value, shape)
    given = as_expr(value)
    if given.sx.is_constant() and not given.sx.is_regular():
        raise DeclarationError(f"{what} of `{path}` is {value!r}; it must be finite.")
    if not given.shape and shape:
        given = Expr(combined(ca.SX.ones(*shape), "*", given.sx), given.unit, shape=shape)
    elif given.shape != shape:
        raise DeclarationError(misshapen(f"{what} of `{path}`", value, given.shape, shape))
    if what == "start":
        unit_rules.common(variable, given, "its start value")
    elif given.sx.is_constant() and not all(float(entry) > 0 for entry in scalars(given.sx)):
        raise DeclarationError(f"{what} of `{path}` is {value!r}; it must be positive: it is the typical size.")
    return given
