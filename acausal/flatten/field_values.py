"""Values of the fields of a bound component: by path, constructor, class body or default."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.component_tree import join
from acausal.flatten.numeric import is_symbolic, misshapen, numeric
from acausal.flatten.origin import Origin, value_origin, with_place
from acausal.flatten.structural import structural_value
from acausal.language import fields as f
from acausal.language import quantities, unit_rules
from acausal.language.call_arguments import declaration_error
from acausal.language.component import Component
from acausal.language.driven import Driven, law_of
from acausal.language.expression import Expr, as_expr
from acausal.language.external import External
from acausal.language.functions import time
from acausal.language.table import Table
from acausal.language.value_checks import shown
from acausal.symbols import scalars
from acausal.units import parse

_TIME = time.sx.element_hash()
# Component, field, function that returns its value, and origin.
DeferredInput = tuple[Component, str, Callable[[], Any], Origin]


@dataclass
class Parameters:
    """Free parameters of a model, scalar symbols with values, and the limits of all parameters.

    `tables` are the tables by the place of their number; `raised` see `add_table`.
    `structural_zeros` are the names of entries that are exactly 0 and have no symbol; `bound` are the paths of
    parameters that depend on others, `defaults` those of parameters that take their default.
    """

    names: list[str] = field(default_factory=list)
    symbols: list[ca.SX] = field(default_factory=list)
    values: list[float] = field(default_factory=list)
    structural_zeros: list[str] = field(default_factory=list)
    bound: dict[str, str] = field(default_factory=dict)
    defaults: list[str] = field(default_factory=list)
    limits: list[tuple[str, ca.SX, f.Parameter]] = field(default_factory=list)
    tables: dict[int, Table | External] = field(default_factory=dict)
    raised: set[int] = field(default_factory=set)

    def add_table(self, symbol: ca.SX, table: Table | External, raised: bool) -> None:
        """Add the number of the first column of a table; `raised` where its derivative is requested."""
        self.tables[len(self.names)] = table
        self.raised |= {len(self.names)} if raised else set()
        self.names.append(symbol.name())
        self.symbols.append(symbol)
        self.values.append(float(table.number))


class FieldValues:
    """Evaluation of structural parameters, parameters and top-level inputs of bound components.

    Values are formed on demand: defaults may use each other in any order, but not in a cycle.

    Parameters
    ----------
    overrides : mapping of str to value, optional
        Values by path, instead of those in the model; used ones are removed.
    free : collection of str
        Parameters, or entries of them, that keep a symbol even if they are 0; `kept` collects those that exist.

    Attributes
    ----------
    deferred : list of (Component, str, callable, Origin)
        Inputs of parts whose values may contain variables; they are evaluated when these exist.
    defaults : list of (Component, str, callable, Origin)
        Inputs of parts with a default, likewise.
    """

    def __init__(self, overrides: Mapping[str, Any] | None, free: Collection[str] = ()) -> None:
        self.overrides = dict(overrides or {})
        self.free, self.kept = set(free), set[str]()
        self.parameters = Parameters()
        self.deferred: list[DeferredInput] = []
        self.defaults: list[DeferredInput] = []
        self._open: list[tuple[Component, str]] = []

    def fill(self, bound: Component, owner: Component | None) -> None:
        """Set the structural parameters and parameters of a component, and the inputs of the whole model."""
        own = vars(bound)
        own["_demand"] = lambda name: self._value(bound, name)
        for kind in (f.Structural, f.Parameter):
            for name, declared in bound.fields.items():
                if isinstance(declared, kind):
                    self._value(bound, name)
        del own["_demand"]
        for name, declared in bound.fields.items():
            if isinstance(declared, f.Variable):
                if owner is not None and declared.default is not f.MISSING:
                    here = value_origin(bound, name, text=f"default of {name}")
                    self.defaults.append((bound, name, partial(self._evaluated, bound, name, declared.default), here))
                if name in bound._class_values and name not in own["_values"]:
                    value = own["_values"][name] = bound._class_values[name]
                    if owner is not None and takes_variables(declared, value):
                        here = value_origin(bound, name, text=f"default of {name}")
                        self.deferred.append((bound, name, partial(self._of_class, bound, name), here))
                    else:
                        own["_values"][name] = self._of_class(bound, name)
                if owner is None and declared.causality == "input":
                    self._top_input(bound, name, declared)

    def _value(self, bound: Component, name: str) -> Any:
        own, here = vars(bound), (bound, name)
        if name in own:
            return own[name]
        if here in self._open:
            cycle = " -> ".join(n for _, n in (*self._open[self._open.index(here) :], here))
            raise DeclarationError(
                f"the values of {owner_text(bound)} depend on each other in a cycle: {cycle}. "
                f"Give one of them: {type(bound).__name__}(..., {name}=...)."
            )
        self._open.append(here)
        try:
            declared = bound.fields[name]
            make: Any = self._structural if isinstance(declared, f.Structural) else self._parameter
            own[name] = make(bound, name, declared)
        finally:
            self._open.pop()
        return own[name]

    def _of_class(self, bound: Component, name: str) -> Any:
        """Return the value of an inherited field from a class body."""
        return self._evaluated(bound, name, bound._class_values[name])

    def _evaluated(self, bound: Component, name: str, value: Any) -> Any:
        """Return the evaluated default of a field, or its value from a class body."""

        def call() -> Any:
            return f.evaluate(value(bound) if callable(value) else value, bound)

        # The outermost default locates an error in a default that it needs.
        return call() if len(self._open) > 1 else with_place(call, value_origin(bound, name, text=f"default of {name}"))

    def _specified(self, bound: Component, name: str, declared: f.Field) -> Any:
        value = self.overrides.pop(join(bound._path, name), f.MISSING)
        if value is f.MISSING:
            value = bound._values.get(name, f.MISSING)
        if value is f.MISSING:
            default = bound._class_values.get(name, declared.default)
            self.parameters.defaults.append(join(bound._path, name))
            value = self._evaluated(bound, name, default)
            if value is None and callable(default) and isinstance(declared, f.Parameter):
                value = f.MISSING
        if value is f.MISSING:
            raise DeclarationError(
                f"{owner_text(bound)} needs a value for `{name}` ({declared.description}): "
                f"{type(bound).__name__}(..., {name}=...)."
            )
        return value

    def _structural(self, bound: Component, name: str, declared: f.Structural) -> Any:
        where = f"`{name}` of {self._origin(bound, name).owner}"
        given = quantities.plain(self._specified(bound, name, declared), None, where)
        value = structural_value(bound, declared, given, where)
        return value.at(join(bound._path, name)) if isinstance(value, Table) else value

    def _parameter(self, bound: Component, name: str, declared: f.Parameter) -> Expr:
        origin = self._origin(bound, name)
        value = self._specified(bound, name, declared)
        path = join(bound._path, name)
        where = f"`{name}` of {origin.owner}"
        shape, unit = shape_of(declared, bound), unit_of(declared, bound)
        value = quantities.plain(value, unit, where)
        if not is_symbolic(value):
            expression = self._free(path, numeric(value, shape, where), unit)
        else:
            given = with_place(lambda: as_expr(value), origin)
            if given.shape != shape:
                raise DeclarationError(misshapen(where, value, given.shape, shape))
            if any(s.is_constant() and not math.isfinite(float(s)) for s in scalars(given.sx)):
                raise DeclarationError(
                    f"{Origin.of(bound)}: `{name}` is not a finite number: it is divided by a parameter that is 0"
                    f"{_zeros_of(bound)}. Give that another value."
                )
            symbols = ca.symvar(given.sx) if not given.sx.is_constant() else []
            if any(s.element_hash() == _TIME for s in symbols):
                raise DeclarationError(
                    f"{where} depends on `time`, which changes in a run; a parameter takes numbers and parameters."
                )
            own = Expr(given.sx, unit, path, shape)
            with_place(lambda: unit_rules.check_value(own, given), replace(origin, text=""))
            self.parameters.bound[path] = ", ".join(s.name() for s in symbols) or "others that are 0"
            expression = own
        if declared.positive and not is_symbolic(value) and expression.sx.is_zero():  # others may be divided by it
            of = f" of {owner_text(bound)}" if bound._path else ""
            raise DeclarationError(f"`{path}` ({declared.description}){of} is 0; it must be greater than 0.")
        if declared.positive or declared.minimum is not None:
            self.parameters.limits.append((path, expression.sx, declared))
        return expression

    def _top_input(self, bound: Component, name: str, declared: f.Variable) -> None:
        """Set an input of the whole model: a law, or a free parameter whatever its value."""
        shape, unit = shape_of(declared, bound), unit_of(declared, bound)
        where = f"`{name}` of {self._origin(bound, name).owner}"
        given = self.overrides.pop(name, vars(bound)["_values"].pop(name, self._start(bound, name, declared)))
        if isinstance(given, Table | Driven):
            vars(bound)[name] = law_of(given, name, shape, unit)
            return
        given = quantities.plain(given, unit, where)
        if is_symbolic(given):
            raise DeclarationError(
                f"{where} is {given!r}, but an input of the whole model takes a number. {law_of_input(bound, name)}"
            )
        listed = isinstance(given, list | tuple | np.ndarray)
        value = numeric(given, shape if listed else (), where, law_of_input(bound, name))
        vars(bound)[name] = self._free(name, np.broadcast_to(value, shape), unit, fold=False)

    def _start(self, bound: Component, name: str, declared: f.Variable) -> Any:
        """Return the default value of an input of the whole model."""
        default = declared.default
        return declared.start if default is f.MISSING else self._evaluated(bound, name, default)

    def _origin(self, bound: Component, name: str) -> Origin:
        """Return the origin of the value of a field."""
        return value_origin(bound, name, by_path=join(bound._path, name) in self.overrides)

    def _free(self, path: str, value: np.ndarray, unit: Any, fold: bool = True) -> Expr:
        """Return a parameter with a symbol for each entry that is not exactly 0."""
        entries = []
        for index in np.ndindex(value.shape):
            name = path + (f"[{','.join(map(str, index))}]" if index else "")
            kept = {path, name} & self.free
            self.kept |= kept
            if fold and value[index] == 0 and not kept:
                self.parameters.structural_zeros.append(name)
                entries.append(ca.SX(0))
                continue
            symbol = ca.SX.sym(name)
            self.parameters.names.append(name)
            self.parameters.symbols.append(symbol)
            self.parameters.values.append(float(value[index]))
            entries.append(symbol)
        sx = entries[0] if not value.shape else ca.vertcat(*entries)
        return Expr(ca.reshape(sx, *value.shape[::-1]).T if value.ndim == 2 else sx, unit, path, value.shape)


def takes_variables(declared: f.Field | None, value: Any) -> bool:
    """Return whether the value of a field of a part may contain variables: the value of an input, no start value."""
    return isinstance(declared, f.Variable) and not isinstance(value, f.InitialValue)


def shape_of(declared: f.Field, owner: Component) -> tuple[int, ...]:
    """Return the declared shape of a field, by default that of a scalar."""
    shape = declared.shape(owner) if callable(declared.shape) else declared.shape or ()
    sizes = (int, np.integer)
    fits = isinstance(shape, tuple) and all(isinstance(n, sizes) and not isinstance(n, bool) and n >= 0 for n in shape)
    if not fits or len(shape) > 2:
        path = join(owner._path, declared.name)
        raise declaration_error(
            f"the shape of `{path}` is {shown(shape)}; a vector has (3,), a matrix (3, 3).", declared.where
        )
    return tuple(int(n) for n in shape)


def unit_of(declared: f.Field, owner: Component) -> Any:
    """Return the declared unit of a field, a Dimension or a tuple of them, or None."""
    unit = declared.unit(owner) if callable(declared.unit) else declared.unit
    if unit is None or isinstance(unit, str):
        return None if unit is None else parse(unit)
    return tuple(parse(u) for u in unit)


def _zeros_of(bound: Component) -> str:
    """Return text with the parameters of a component that are 0."""
    known = [(n, vars(bound).get(n)) for n, d in bound.fields.items() if isinstance(d, f.Parameter)]
    names = [f"`{n}`" for n, value in known if isinstance(value, Expr) and value.sx.is_zero()]
    return f", here {' or '.join(names)}" if names else ""


def law_of_input(model: Component, name: str) -> str:
    """Return the remedy for an input that varies in time: an input of the whole model is constant in a run."""
    kind = type(model).__name__
    return f"Give a function of time where {kind} is a part: `class Whole(Model): part = {kind}({name}=...)`."


def owner_text(component: Component) -> str:
    """Return path, class and line of a component, for messages."""
    return Origin.of(component).owner if component._path else type(component).__name__
