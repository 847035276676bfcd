"""Hear components that are alike once, and write what they state in the symbols of each.

Components are alike if they have one class, equal structural values and constants, and share symbols among their fields
in the same places. One of them states its equations in symbols of no model; as a function of these, which CasADi writes
out, the statements are those of each of the others. What depends on more than fields is heard from each: what requests
switches or jumps, and what is wrong, so that messages are those of the component itself.
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

FEWEST = 4  # alike components for which preparing a function pays
ENGINE = {*vars(Component), *vars(Connector)}  # attributes that are no values of a component
Stated = tuple[Any, Origin]
Hear = Callable[[Component], Iterable[Stated]]
_Entries = dict[int, tuple[int, ca.SX]]  # by their hash, with their places


@dataclass(frozen=True)
class _Look:
    """Symbols of a component in the order that alike components have in common.

    Parameters
    ----------
    variables : list of Expr
        Of the component and its parts.
    entries : list of casadi.SX
        Entries of its other expressions that are no numbers, each once.
    """

    variables: list[Expr]
    entries: list[ca.SX]

    def symbols(self) -> list[ca.SX]:
        """Arguments of the function of what alike components state."""
        return [*[v.sx for v in self.variables], *self.entries]


@dataclass(frozen=True)
class _Template:
    """What alike components state, as a function of their symbols, of derivatives and of symbols common to all."""

    kind: type
    stated: list[tuple[list[tuple[int, ...]], Origin]]
    shapes: list[tuple[int, int]]
    common: ca.SX
    function: ca.Function

    def of(self, component: Component, look: _Look) -> Iterator[Stated]:
        """Yield what a component states."""
        if not self.stated and not self.shapes:
            return
        derivatives = [ca.SX.sym("der", *shape) for shape in self.shapes]
        found = iter(self.function.call([*look.symbols(), *derivatives, self.common]))
        PENDING.get().derivatives += [(d, next(found)) for d in derivatives]
        for shapes, origin in self.stated:
            place = Origin(component._path, origin.kind, origin.where, origin.text)
            parts = [Expr(next(found), shape=shape) for shape in shapes]
            yield parts[0] if self.kind is Expr else Equation(*parts) if self.kind is Equation else tuple(parts), place


class TemplateReuse:
    """Components of a model by what they are like.

    Parameters
    ----------
    components : iterable of Component
        Bound, with their variables, each once.
    """

    def __init__(self, components: Iterable[Component]) -> None:
        components = list(components)
        classes = Counter(map(type, components))
        self._common: dict[int, dict[int, Hashable]] = {}
        kinds: dict[Hashable, dict[int, _Look]] = {}
        for component in components:
            if classes[type(component)] >= FEWEST and (found := self._look(component)):
                kinds.setdefault(found[0], {})[id(component)] = found[1]
        self._looks = {
            place: (number, look)
            for number, looks in enumerate(kinds.values())
            if len(looks) >= FEWEST
            for place, look in looks.items()
        }
        self._templates: dict[tuple[str, int], _Template | None] = {}

    def statements(self, component: Component, method: str, kind: type, hear: Hear) -> Iterable[Stated]:
        """Return what a component states in a method, with the place of each statement.

        Parameters
        ----------
        component : Component
            Bound, with its variables.
        method : str
            The method.
        kind : type
            What it should state: Equation, Expr, or tuple of several of these.
        hear : callable
            Runs the method of a component.
        """
        if id(component) not in self._looks:
            return hear(component)
        number, look = self._looks[id(component)]
        place = method, number
        if place not in self._templates:
            self._templates[place] = _template(component, look, kind, hear)
        template = self._templates[place]
        return hear(component) if template is None else template.of(component, look)

    def _look(self, component: Component) -> tuple[Hashable, _Look] | None:
        """What is equal for components that are alike, and the symbols of one; None if it has discrete variables."""
        inside = list(walk(component))
        places = {id(c): k for k, c in enumerate(inside)}
        key, variables, entries, at = list[Hashable](), list[Expr](), _Entries(), dict[int, Hashable]()
        for c in inside:
            for name, declared in c.fields.items():
                if isinstance(declared, f.Outer):
                    at |= self._outside(vars(c)[name])
        for c in inside:
            key += [type(c), c._in_loop, _standing(c, places)]
            for name, value in vars(c).items():
                declared = c.fields.get(name)
                if name in ENGINE:
                    continue
                key.append(name)
                if isinstance(declared, f.Part | f.Outer):
                    key.append(id(value) if isinstance(declared, f.Outer) else _count(value))
                elif not isinstance(value, Expr):
                    key.append(_datum(value) if isinstance(declared, f.Structural) else _plain(value))
                elif not isinstance(declared, f.Variable):
                    key.append((value.unit, value.shape, _entries(value.sx, entries)))
                elif declared.causality == "discrete":
                    return None
                else:
                    if id(value) not in at:
                        at[id(value)] = len(variables)
                        variables.append(value)
                    key.append((value.unit, value.shape, at[id(value)]))
        return tuple(key), _Look(variables, [entry for _, entry in entries.values()])

    def _outside(self, outer: Component) -> dict[int, Hashable]:
        """Symbols of a component that others read, which stand for themselves."""
        if id(outer) not in self._common:
            values = (value for c in walk(outer) for value in vars(c).values())
            self._common[id(outer)] = {id(v): ("common", id(v)) for v in values if isinstance(v, Expr)}
        return self._common[id(outer)]


def _standing(c: Component, places: dict[int, int]) -> Hashable:
    """How a connector stands in the spanning tree, as far as the component that has it can see."""
    if not isinstance(c, Connector):
        return None
    return c._is_root, tuple((places.get(id(p), -1), p._owner is c._owner) for p in c._parents)


def _count(part: Any) -> Hashable:
    """How many components a part is; they are looked at themselves."""
    return len(part) if isinstance(part, list) else part is not None


def _plain(value: Any) -> Hashable:
    """What is equal for equal values alone; what cannot be compared is equal to itself."""
    if value is None or isinstance(value, bool | int | float | str):
        return type(value), repr(value)
    if type(value) is np.ndarray and value.dtype != object:
        return value.shape, value.dtype.str, value.tobytes()
    if type(value) in (list, tuple):
        return type(value), tuple(map(_plain, value))
    return type(value), id(value)


def _datum(value: Any) -> Hashable:
    """What is equal for equal structural values: by their own word where they are compared by more than their identity."""
    if type(value).__hash__ not in (None, object.__hash__) and not isinstance(value, tuple):
        with suppress(TypeError):  # a frozen record of arrays cannot be hashed
            hash(value)
            return type(value), value
    return _plain(value)


def _entries(sx: ca.SX, found: _Entries) -> Hashable:
    """Numbers in a parameter, and the places of its other entries among those that were found before."""
    key: list[Hashable] = [sx.nnz()]
    for entry in scalars(sx):
        if entry.is_constant():
            key.append(repr(float(entry)))
        else:
            key.append(found.setdefault(entry.element_hash(), (len(found), entry))[0])
    return tuple(key)


def _template(component: Component, look: _Look, kind: type, hear: Hear) -> _Template | None:
    """Hear a component in symbols of no model; None if what it states depends on more than these."""
    own = _Look([_anew(v) for v in look.variables], [ca.SX.sym(f"p{k}") for k in range(len(look.entries))])
    twins: dict[int, Any] = {id(c): copy(c) for c in walk(component)}
    twins |= zip(map(id, look.variables), own.variables, strict=True)
    entries = dict(zip((e.element_hash() for e in look.entries), own.entries, strict=True))

    def twin(value: Any) -> Any:
        if isinstance(value, list | tuple) and any(isinstance(v, Component) for v in value):
            return type(value)(map(twin, value))
        return twins.get(id(value), value)

    for c in walk(component):
        for name, value in vars(c).items():
            entered = isinstance(value, Expr) and not isinstance(c.fields.get(name), f.Variable)
            vars(twins[id(c)])[name] = _renamed(value, entries) if entered else twin(value)
    pending = Pending()
    pending.varying = {s.element_hash() for v in own.variables for s in scalars(v.sx)}
    token = PENDING.set(pending)
    try:
        stated = list(hear(twins[id(component)]))
    except AcausalError:
        return None
    finally:
        PENDING.reset(token)
    return _function(stated, kind, own, pending)


def _anew(variable: Expr) -> Expr:
    return Expr(ca.SX.sym(variable.name, *variable.sx.shape), variable.unit, variable.name, variable.shape)


def _renamed(parameter: Expr, entries: dict[int, ca.SX]) -> Expr:
    sx = ca.SX(parameter.sx)
    nonzeros: list[Any] = sx.nonzeros()
    for k, entry in enumerate(nonzeros):
        if not entry.is_constant():
            sx.nz[k] = entries[entry.element_hash()]
    return Expr(sx, parameter.unit, parameter.name, parameter.shape)


def _function(stated: list[Stated], kind: type, own: _Look, pending: Pending) -> _Template | None:
    """What was stated as a function of the symbols that it was stated in."""
    if pending.switches or pending.whens or pending.promises or not all(isinstance(s, kind) for s, _ in stated):
        return None
    if any(isinstance(s, Soft) for s, _ in stated):
        return None  # few, and simple ones
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
