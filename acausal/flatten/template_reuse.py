"""Reuse of statements among equal components: one states its equations, the others substitute their symbols.

Components are equal if they have one class, equal structural values and constants, and share symbols among their fields
in the same places. One of them states its equations in new symbols; CasADi evaluates them, as a function of these
symbols, for each of the others. Methods that request switches or jumps, or that raise an error, run for each component,
so that messages name the component itself.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator
from contextlib import suppress
from copy import copy
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import AcausalError
from acausal.flatten.component_tree import walk
from acausal.flatten.origin import Origin
from acausal.language import fields as f
from acausal.language.component import Component, Connector
from acausal.language.expression import Equation, Expr
from acausal.language.pending import PENDING, Pending
from acausal.language.soft import Soft
from acausal.symbols import scalars, stacked, vec

FEWEST = 4  # equal components for which a function pays
ENGINE = {*vars(Component), *vars(Connector)}  # attributes that are not field values
Stated = tuple[Any, Origin]
Run = Callable[[Component], Iterable[Stated]]
_Entries = dict[int, tuple[int, ca.SX]]  # hash -> (position, entry)


@dataclass(frozen=True)
class _Arguments:
    """Symbols of a component, in an order that equal components have in common.

    Parameters
    ----------
    variables : list of Expr
        Variables of the component and its parts.
    entries : list of casadi.SX
        Symbolic entries of its other expressions, each once.
    """

    variables: list[Expr]
    entries: list[ca.SX]

    def symbols(self) -> list[ca.SX]:
        """Return the arguments of the function of a template."""
        return [*[v.sx for v in self.variables], *self.entries]


@dataclass(frozen=True)
class _Template:
    """Statements of equal components as a function of their symbols, of derivatives and of common symbols."""

    kind: type
    stated: list[tuple[list[tuple[int, ...]], Origin]]
    shapes: list[tuple[int, int]]
    common: ca.SX
    function: ca.Function

    def of(self, component: Component, arguments: _Arguments) -> Iterator[Stated]:
        """Yield the statements of a component."""
        if not self.stated and not self.shapes:
            return
        derivatives = [ca.SX.sym("der", *shape) for shape in self.shapes]
        found = iter(self.function.call([*arguments.symbols(), *derivatives, self.common]))
        PENDING.get().derivatives += [(d, next(found)) for d in derivatives]
        for shapes, origin in self.stated:
            place = Origin(component._path, origin.kind, origin.where, origin.text)
            parts = [Expr(next(found), shape=shape) for shape in shapes]
            yield parts[0] if self.kind is Expr else Equation(*parts) if self.kind is Equation else tuple(parts), place


class TemplateReuse:
    """Equal components of a model, and the templates of their statements.

    Parameters
    ----------
    components : iterable of Component
        Bound components with variables, each once.
    """

    def __init__(self, components: Iterable[Component]) -> None:
        components = list(components)
        classes = Counter(map(type, components))
        self._common: dict[int, dict[int, Hashable]] = {}
        kinds: dict[Hashable, dict[int, _Arguments]] = {}
        for component in components:
            if classes[type(component)] >= FEWEST and (found := self._key(component)):
                kinds.setdefault(found[0], {})[id(component)] = found[1]
        self._arguments = {
            place: (number, arguments)
            for number, members in enumerate(kinds.values())
            if len(members) >= FEWEST
            for place, arguments in members.items()
        }
        self._templates: dict[tuple[str, int], _Template | None] = {}

    def statements(self, component: Component, method: str, kind: type, run: Run) -> Iterable[Stated]:
        """Return the statements of a method of a component, each with its origin.

        Parameters
        ----------
        component : Component
            Bound component with variables.
        method : str
            Name of the method.
        kind : type
            Kind of its statements: Equation, Expr, or tuple of several of these.
        run : callable
            Runs the method of a component.
        """
        if id(component) not in self._arguments:
            return run(component)
        number, arguments = self._arguments[id(component)]
        place = method, number
        if place not in self._templates:
            self._templates[place] = _template(component, arguments, kind, run)
        template = self._templates[place]
        return run(component) if template is None else template.of(component, arguments)

    def _key(self, component: Component) -> tuple[Hashable, _Arguments] | None:
        """Return a key, equal for equal components, and the symbols of one; None with discrete variables."""
        inside = list(walk(component))
        places = {id(c): k for k, c in enumerate(inside)}
        key, variables, entries, at = list[Hashable](), list[Expr](), _Entries(), dict[int, Hashable]()
        for c in inside:
            for name, declared in c.fields.items():
                if isinstance(declared, f.Outer):
                    at |= self._outside(vars(c)[name])
        for c in inside:
            key += [type(c), c._in_loop, _position_in_tree(c, places)]
            for name, value in vars(c).items():
                declared = c.fields.get(name)
                if name in ENGINE:
                    continue
                key.append(name)
                if isinstance(declared, f.Part | f.Outer):
                    key.append(id(value) if isinstance(declared, f.Outer) else _count(value))
                elif not isinstance(value, Expr):
                    key.append(_structural_key(value) if isinstance(declared, f.Structural) else _plain(value))
                elif not isinstance(declared, f.Variable):
                    key.append((value.unit, value.shape, _entries(value.sx, entries)))
                elif declared.causality == "discrete":
                    return None
                else:
                    if id(value) not in at:
                        at[id(value)] = len(variables)
                        variables.append(value)
                    key.append((value.unit, value.shape, at[id(value)]))
        return tuple(key), _Arguments(variables, [entry for _, entry in entries.values()])

    def _outside(self, outer: Component) -> dict[int, Hashable]:
        """Return keys of the symbols of an outer component, which are common to all."""
        if id(outer) not in self._common:
            values = (value for c in walk(outer) for value in vars(c).values())
            self._common[id(outer)] = {id(v): ("common", id(v)) for v in values if isinstance(v, Expr)}
        return self._common[id(outer)]


def _position_in_tree(c: Component, places: dict[int, int]) -> Hashable:
    """Return the position of a connector in the spanning tree, as visible to its component."""
    if not isinstance(c, Connector):
        return None
    return c._is_root, tuple((places.get(id(p), -1), p._owner is c._owner) for p in c._parents)


def _count(part: Any) -> Hashable:
    """Return the number of components of a part, whose own keys follow."""
    return len(part) if isinstance(part, list) else part is not None


def _plain(value: Any) -> Hashable:
    """Return a key of a value, equal for equal values; other objects are compared by identity."""
    if value is None or isinstance(value, bool | int | float | str):
        return type(value), repr(value)
    if type(value) is np.ndarray and value.dtype != object:
        return value.shape, value.dtype.str, value.tobytes()
    if type(value) in (list, tuple):
        return type(value), tuple(map(_plain, value))
    return type(value), id(value)


def _structural_key(value: Any) -> Hashable:
    """Return a key of a structural value, which is the value itself if its class defines a hash."""
    if type(value).__hash__ not in (None, object.__hash__) and not isinstance(value, tuple):
        with suppress(TypeError):  # a frozen record of arrays cannot be hashed
            hash(value)
            return type(value), value
    return _plain(value)


def _entries(sx: ca.SX, found: _Entries) -> Hashable:
    """Return the numbers in a parameter, and the positions of its symbolic entries among those found before."""
    key: list[Hashable] = [sx.nnz()]
    for entry in scalars(sx):
        if entry.is_constant():
            key.append(repr(float(entry)))
        else:
            key.append(found.setdefault(entry.element_hash(), (len(found), entry))[0])
    return tuple(key)


def _template(component: Component, arguments: _Arguments, kind: type, run: Run) -> _Template | None:
    """Return the statements of a component in new symbols; None if they depend on more than these."""
    own = _Arguments(
        [_new_symbol(v) for v in arguments.variables], [ca.SX.sym(f"p{k}") for k in range(len(arguments.entries))]
    )
    copies: dict[int, Any] = {id(c): copy(c) for c in walk(component)}
    copies |= zip(map(id, arguments.variables), own.variables, strict=True)
    entries = dict(zip((e.element_hash() for e in arguments.entries), own.entries, strict=True))

    def copied(value: Any) -> Any:
        if isinstance(value, list | tuple) and any(isinstance(v, Component) for v in value):
            return type(value)(map(copied, value))
        return copies.get(id(value), value)

    for c in walk(component):
        for name, value in vars(c).items():
            is_parameter = isinstance(value, Expr) and not isinstance(c.fields.get(name), f.Variable)
            vars(copies[id(c)])[name] = _renamed(value, entries) if is_parameter else copied(value)
    pending = Pending()
    pending.varying = {s.element_hash() for v in own.variables for s in scalars(v.sx)}
    token = PENDING.set(pending)
    try:
        stated = list(run(copies[id(component)]))
    except AcausalError:
        return None
    finally:
        PENDING.reset(token)
    return _function(stated, kind, own, pending)


def _new_symbol(variable: Expr) -> Expr:
    return Expr(ca.SX.sym(variable.name, *variable.sx.shape), variable.unit, variable.name, variable.shape)


def _renamed(parameter: Expr, entries: dict[int, ca.SX]) -> Expr:
    sx = ca.SX(parameter.sx)
    nonzeros: list[Any] = sx.nonzeros()
    for k, entry in enumerate(nonzeros):
        if not entry.is_constant():
            sx.nz[k] = entries[entry.element_hash()]
    return Expr(sx, parameter.unit, parameter.name, parameter.shape)


def _function(stated: list[Stated], kind: type, own: _Arguments, pending: Pending) -> _Template | None:
    """Return statements as a function of the symbols of their component; None for unsuitable ones."""
    if (
        pending.switches
        or pending.whens
        or pending.smooth_steps
        or pending.tables
        or not all(isinstance(s, kind) for s, _ in stated)
    ):
        return None
    if any(isinstance(s, Soft) for s, _ in stated):
        return None  # soft equations are few and simple
    parts = [(s.lhs, s.rhs) if kind is Equation else (s,) if kind is Expr else s for s, _ in stated]
    if not all(isinstance(e, Expr) for exprs in parts for e in exprs):
        return None
    derivatives = [placeholder for placeholder, _ in pending.derivatives]
    results = [e for _, e in pending.derivatives] + [e.sx for exprs in parts for e in exprs]
    given = [*own.symbols(), *derivatives]
    known = {s.element_hash() for sx in given for s in scalars(sx)}
    common = stacked([s for s in ca.symvar(stacked(map(vec, results))) if s.element_hash() not in known])
    return _Template(
        kind,
        [([e.shape for e in exprs], origin) for (_, origin), exprs in zip(stated, parts, strict=True)],
        [d.shape for d in derivatives],
        common,
        ca.Function("stated", [*given, common], results),
    )
