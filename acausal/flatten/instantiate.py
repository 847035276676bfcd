"""Instantiate: from templates to a tree of bound components with values, parameters, parts and ports."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.flatten.origin import Origin, with_place
from acausal.language import fields as f
from acausal.language import unit_rules
from acausal.language.component import Component, Connector
from acausal.language.expression import Expr, as_expr
from acausal.units import parse


@dataclass
class Parameters:
    """The free parameters of a model: scalar symbols with their values, and every bound that must hold.

    `structural_zeros` are the entries that were exactly 0 and have no symbol; `bound` are the paths of parameters
    that follow others.
    """

    names: list[str] = field(default_factory=list)
    symbols: list[ca.SX] = field(default_factory=list)
    values: list[float] = field(default_factory=list)
    structural_zeros: list[str] = field(default_factory=list)
    bound: dict[str, str] = field(default_factory=dict)
    limits: list[tuple[str, ca.SX, f.Parameter]] = field(default_factory=list)


class Instantiation:
    """The tree of bound components of one model.

    Parameters
    ----------
    template : Component
        The model as the user constructed it.
    overrides : mapping of str to value
        Values by path that replace those of the model.
    """

    def __init__(self, template: Component, overrides: Mapping[str, Any] | None = None) -> None:
        self.overrides = dict(overrides or {})
        self.parameters = Parameters()
        self.components: list[Component] = []
        self.root = self._build(template, "", None)
        for component in self.components:
            self._resolve_outers(component)
        if self.overrides:
            name = next(iter(self.overrides))
            raise DeclarationError(not_settable(name, self.root, self.settable()))

    def settable(self) -> list[str]:
        """Paths of all structural parameters and parameters."""
        return [
            join(component._path, name)
            for component in self.components
            for name, declared in component.fields.items()
            if isinstance(declared, f.Structural | f.Parameter)
        ]

    def _build(self, template: Component, path: str, owner: Component | None) -> Component:
        cls = type(template)
        bound = cls.__new__(cls)
        bound._is_bound = True
        bound._path = path
        bound._origin = template._origin
        here = Origin(path, cls.__name__, template._origin)
        bound._values = {
            name: with_place(lambda v=value: f.evaluate(v, owner), here) for name, value in template._values.items()
        }
        self.components.append(bound)
        by_kind = sorted(cls.fields.items(), key=lambda item: _ORDER[type(item[1])])
        parts: list[tuple[str, f.Part]] = []
        for name, declared in by_kind:
            if isinstance(declared, f.Structural):
                setattr(bound, name, self._structural(bound, name, declared))
            elif isinstance(declared, f.Parameter):
                setattr(bound, name, self._parameter(bound, name, declared))
            elif isinstance(declared, f.Part):
                parts.append((name, declared))
            elif owner is None and isinstance(declared, f.Variable) and declared.causality == "input":
                self._top_input(bound, name, declared)
        with_place(bound.check, here)
        for name, declared in parts:
            self._part(bound, name, declared)
        bound._ports = tuple(getattr(bound, name) for name, _ in parts if isinstance(getattr(bound, name), Connector))
        return bound

    def _given(self, bound: Component, name: str, declared: f.Field) -> Any:
        value = self.overrides.pop(join(bound._path, name), f.MISSING)
        if value is f.MISSING:
            value = bound._values.get(name, f.MISSING)
        if value is f.MISSING:
            value = self._default(bound, declared)
        if value is f.MISSING:
            raise DeclarationError(
                f"{_owner_text(bound)} needs a value for `{name}` ({declared.description}): "
                f"{type(bound).__name__}(..., {name}=...)."
            )
        return value

    def _default(self, bound: Component, declared: f.Field) -> Any:
        if not callable(declared.default):
            return declared.default
        return with_place(lambda: declared.default(bound), Origin.of(bound, f"default of {declared.name}"))

    def _structural(self, bound: Component, name: str, declared: f.Structural) -> Any:
        value = self._given(bound, name, declared)
        where = f"`{name}` of {_owner_text(bound)}"
        if _symbolic(value):
            raise DeclarationError(
                f"{where} is structural: it cannot follow the parameter {value!r}, which may change after compiling. "
                "Declare that one structural(...) as well."
            )
        if declared.choices is not None and not any(value is c or value == c for c in declared.choices):
            raise DeclarationError(f"{where} is {value!r}; it must be one of {', '.join(map(repr, declared.choices))}.")
        if declared.minimum is not None and not (isinstance(value, int | float) and value >= declared.minimum):
            raise DeclarationError(f"{where} is {value!r}; it must be a number of at least {declared.minimum:g}.")
        whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
        if type(declared.default) is int and value is not None and not whole:
            raise DeclarationError(f"{where} is {value!r}; it must be a whole number.")
        if isinstance(declared.shape, tuple):
            value = numeric(value, declared.shape, where)
        return value

    def _parameter(self, bound: Component, name: str, declared: f.Parameter) -> Expr:
        value = self._given(bound, name, declared)
        path = join(bound._path, name)
        where = f"`{name}` of {_owner_text(bound)}"
        shape = declared.shape(bound) if callable(declared.shape) else declared.shape
        unit = unit_of(declared, bound)
        if not _symbolic(value):
            expression = self._free(path, numeric(value, shape or (), where), unit)
        else:
            given = as_expr(value)
            if given.shape != (shape or ()):
                raise DeclarationError(f"{where} has shape {given.shape}; it must have shape {shape or ()}.")
            unit_rules.common(Expr(given.sx, unit, where), given, "its value")
            self.parameters.bound[path] = ", ".join(s.name() for s in ca.symvar(given.sx)) or "others that are 0"
            expression = Expr(given.sx, unit, path)
        if declared.positive or declared.minimum is not None:
            self.parameters.limits.append((path, expression.sx, declared))
        return expression

    def _top_input(self, bound: Component, name: str, declared: f.Variable) -> None:
        """An input at the top of the model is a parameter, whatever its value."""
        shape = declared.shape if isinstance(declared.shape, tuple) else ()
        given = self.overrides.pop(name, bound._values.pop(name, declared.start))
        value = np.broadcast_to(numeric(given, np.shape(given), f"`{name}` of {_owner_text(bound)}"), shape)
        setattr(bound, name, self._free(name, value, unit_of(declared, bound), fold=False))

    def _free(self, path: str, value: np.ndarray, unit: Any, fold: bool = True) -> Expr:
        """Make a symbol for each entry that is not exactly 0."""
        entries = []
        for index in np.ndindex(value.shape):
            name = path + (f"[{','.join(map(str, index))}]" if index else "")
            if fold and value[index] == 0:
                self.parameters.structural_zeros.append(name)
                entries.append(ca.SX(0))
                continue
            symbol = ca.SX.sym(name)
            self.parameters.names.append(name)
            self.parameters.symbols.append(symbol)
            self.parameters.values.append(float(value[index]))
            entries.append(symbol)
        sx = ca.vertcat(*entries)
        return Expr(ca.reshape(sx, *value.shape[::-1]).T if value.ndim == 2 else sx, unit, path)

    def _part(self, bound: Component, name: str, declared: f.Part) -> None:
        path = join(bound._path, name)
        made: Any = bound._values.get(name, f.MISSING)
        if made is f.MISSING:
            make: Any = declared.make
            if isinstance(make, Component):
                made = make
            else:
                call: Any = make if isinstance(make, type) else lambda: make(bound)  # type: ignore[operator]
                made = with_place(call, Origin.of(bound, name))
        if declared.many:
            built: Any = [self._member(bound, item, f"{path}[{k}]") for k, item in enumerate(made)]
        else:
            built = None if made is None else self._member(bound, made, path)
        setattr(bound, name, built)

    def _member(self, bound: Component, template: Component, path: str) -> Component:
        if not isinstance(template, Component):
            raise DeclarationError(f"{path} must be a component, not {template!r}.")
        built = self._build(template, path, bound)
        if isinstance(built, Connector):
            built._owner = bound
        return built

    def _resolve_outers(self, component: Component) -> None:
        for name, declared in component.fields.items():
            if not isinstance(declared, f.Outer):
                continue
            found = [c for c in self.components if isinstance(c, declared.cls)]
            cls = declared.cls.__name__
            if len(found) != 1:
                what = (
                    f"the model has no {cls}. Add one to it: {cls.lower()} = {cls}()"
                    if not found
                    else f"the model has {len(found)}: {', '.join(c._path for c in found)}. Keep one of them"
                )
                raise DeclarationError(f"{_owner_text(component)} needs the one {cls} of the model, but {what}.")
            setattr(component, name, found[0])


_ORDER = {f.Structural: 0, f.Parameter: 1, f.Outer: 2, f.Part: 3, f.Variable: 4, f.Observed: 5}


def walk(component: Component) -> Iterator[Component]:
    """Yield a bound component, its parts and theirs."""
    yield component
    for member in members(component):
        yield from walk(member)


def members(component: Component) -> Iterator[Component]:
    """Yield the parts and ports of a bound component."""
    for name, declared in component.fields.items():
        if isinstance(declared, f.Part):
            value = getattr(component, name)
            yield from (item for item in (value if isinstance(value, list) else [value]) if item is not None)


def join(path: str, name: str) -> str:
    """Return the path of a member."""
    return f"{path}.{name}" if path else name


def unit_of(declared: f.Field, owner: Component) -> Any:
    """Return the Dimension, or tuple of them, that a field declares; None where it declares none."""
    unit = declared.unit(owner) if callable(declared.unit) else declared.unit
    if unit is None or isinstance(unit, str):
        return None if unit is None else parse(unit)
    return tuple(parse(u) for u in unit)


def numeric(value: Any, shape: tuple[int, ...], where: str) -> np.ndarray:
    """Return the value as an array of finite numbers of the given shape, or raise DeclarationError."""
    try:
        if _has_no_number(value):
            raise TypeError
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        wanted = f"an array of numbers of shape {shape}" if shape else "a number"
        raise DeclarationError(f"{where} is {value!r}; it must be {wanted}.") from None
    if array.shape != shape:
        raise DeclarationError(f"{where} has shape {array.shape}; it must have shape {shape}.")
    if not all(math.isfinite(x) for x in array.flat):
        raise DeclarationError(f"{where} is {value!r}; it must be finite.")
    return array


def unknown_name(name: str, known: list[str]) -> str:
    """Return the message for a name that does not exist, with the nearest that do."""
    near = difflib.get_close_matches(name, known, 3, 0.5)
    return f"there is no `{name}` in the model" + (
        f"; did you mean {', '.join(f'`{n}`' for n in near)}?" if near else "."
    )


def not_settable(name: str, root: Component, known: list[str]) -> str:
    """Return the message for a name that is no parameter."""
    for component in walk(root):
        for own, declared in component.fields.items():
            if isinstance(declared, f.Variable) and name == join(component._path, own):
                make = f"{type(component).__name__}({own}=fixed(...))"
                return f"`{name}` is a variable, not a parameter; its start value is given in the model: {make}."
    return unknown_name(name, known)


def _has_no_number(value: Any) -> bool:
    if isinstance(value, list | tuple):
        return any(_has_no_number(item) for item in value)
    return value is None or isinstance(value, bool | str)


def _symbolic(value: Any) -> bool:
    if isinstance(value, list | tuple):
        return any(_symbolic(item) for item in value)
    return isinstance(value, Expr)


def _owner_text(component: Component) -> str:
    kind = type(component).__name__
    return f"{component._path} ({kind}, {component._origin})" if component._path else kind
