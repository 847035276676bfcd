"""The tree of components of a bound model as JSON data, and back as a tree of stand-ins for their classes."""

from __future__ import annotations

import keyword
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from math import isfinite
from typing import Any, ClassVar

import casadi as ca
import numpy as np

from acausal.compiler.requirements import Stated
from acausal.errors import DeclarationError, caution
from acausal.export.dae.json_values import encoded, without_folder
from acausal.flatten.component_tree import join, walk
from acausal.language import fields as f
from acausal.language.component import Component, Connector, Model, Record
from acausal.language.docstring import first_line
from acausal.language.expression import Expr
from acausal.language.validity_statements import Requirement
from acausal.result.lookup import READABLE

Add = Callable[[ca.SX | ca.DM], int]
Decode = Callable[[Any], Any]
BASES: tuple[type[Component], ...] = (Connector, Record, Model, Component)
PLAIN = (bool, int, float, str, type(None))
# Attributes of fields that are read after compiling, besides description, unit and shape.
MORE: dict[type, tuple[str, ...]] = {
    f.Variable: ("causality", "flow", "root", "fixed"),
    f.Parameter: ("minimum", "positive"),
    f.Structural: ("minimum", "effect"),
    f.Part: ("many", "is_port"),
    f.Outer: (),
    f.Observed: (),
}
KINDS = {kind.__name__.lower(): kind for kind in MORE}


def evaluated(tree: Component) -> dict[str, Expr | str]:
    """Return the value of every variable, parameter and observed quantity by path, or the message why it has none."""
    found: dict[str, Expr | str] = {}
    for component in walk(tree):
        for name, declared in component.fields.items():
            observed = isinstance(declared, f.Observed)
            if observed or (isinstance(declared, READABLE) and vars(component).get(name) is not None):
                try:
                    found[join(component._path, name)] = getattr(component, name)
                except DeclarationError as error:
                    found[join(component._path, name)] = str(error)
    return found


def encode_tree(tree: Component, values: Mapping[str, Expr | str], stated: list[Stated], add: Add) -> dict[str, Any]:
    """Return classes and components of a bound model as JSON data, owners before their parts.

    Parameters
    ----------
    tree : Component
        The model.
    values : mapping of str to Expr or str
        From `evaluated`.
    stated : list of (statement, Origin)
        Requirements, expectations and separations to include.
    add : callable
        Function from an expression to its number.
    """
    components = list(walk(tree))
    numbers = {id(component): k for k, component in enumerate(components)}
    classes = {_kind(c): (k, c) for k, c in enumerate({_kind(c): c for c in components}.values())}
    own: dict[str, list[Any]] = {}
    for statement, origin in stated:
        own.setdefault(origin.path, []).append(encoded(statement, add))
    return {
        "classes": [_class(c) for _, c in classes.values()],
        "components": [
            {
                "class": classes[_kind(c)][0],
                "path": c._path,
                "where": without_folder(c._origin),
                "started": [name for name, value in c._values.items() if _is_start(value)],
                "ports": [numbers[id(p)] for p in c._ports if id(p) in numbers],
                "owner": numbers.get(id(c._owner)) if isinstance(c, Connector) else None,
                "members": dict(_members(c, values, numbers, add)),
                "states": own.get(c._path, []),
            }
            for c in components
        ],
    }


def _kind(component: Component) -> tuple[Any, ...]:
    """Return the class and the names of the fields, as an instance may have ports of its own."""
    return type(component), *component.fields


def _class(component: Component) -> dict[str, Any]:
    cls = type(component)
    return {
        "name": cls.__name__,
        "base": next(base for base in BASES if issubclass(cls, base)).__name__,
        "description": first_line(cls),
        "start_words": dict(cls.start_words),
        "fields": [_field(name, declared) for name, declared in component.fields.items()],
    }


def _field(name: str, declared: f.Field) -> dict[str, Any]:
    kind = next(kind for kind in MORE if isinstance(declared, kind))
    found: dict[str, Any] = {"name": name, "kind": kind.__name__.lower(), "description": declared.description}
    found |= {more: getattr(declared, more) for more in MORE[kind]}
    if isinstance(declared, f.Structural):
        found["refine"] = declared.refine is not None
    return found


def _is_start(value: Any) -> bool:
    return value is True or (isinstance(value, f.InitialValue) and value.fixed)


def _members(
    component: Component, values: Mapping[str, Expr | str], numbers: Mapping[int, int], add: Add
) -> Iterator[tuple[str, Any]]:
    """Yield each field of a component with its value as JSON data."""
    for name, declared in component.fields.items():
        own, path = vars(component).get(name), join(component._path, name)
        if isinstance(values.get(path), str):
            yield name, {"refused": values[path]}
        elif path in values:
            yield name, {"value": encoded(values[path], add), **_declared(component, declared)}
        elif isinstance(declared, f.Structural):
            plain = type(own) in PLAIN and not (isinstance(own, float) and not isfinite(own))
            refined = declared.refine is not None and bool(declared.refine(component))
            yield name, {"value": own if plain else {"shown": repr(own)}, "refined": refined}
        elif isinstance(own, list):
            yield name, [numbers[id(part)] for part in own]
        elif id(own) in numbers or (own is None and name in vars(component)):
            yield name, numbers.get(id(own))


def _declared(component: Component, declared: f.Field) -> dict[str, Any]:
    """Return the declared shape and unit, evaluated for an instance."""
    shape = declared.shape(component) if callable(declared.shape) else declared.shape
    unit = declared.unit(component) if callable(declared.unit) else declared.unit
    return {
        "shape": None if shape is None else [int(n) for n in shape],
        "unit": unit if unit is None or isinstance(unit, str) else list(unit),
    }


class StandIn:
    """Base of the classes that stand for unknown classes of components."""

    _states: ClassVar[tuple[Any, ...]] = ()

    def requirements(self) -> Iterator[Any]:
        """Yield the requirements of the exported component."""
        yield from (s for s in self._states if isinstance(s, Requirement))

    def validity(self) -> Iterator[Any]:
        """Yield the expectations and separations of the exported component."""
        yield from (s for s in self._states if not isinstance(s, Requirement))


class Shown:
    """A structural value of which only the representation is known."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __repr__(self) -> str:
        return self.text


class Unchecked:
    """A stand-in for the check of a requirement by a function: it accepts the first value, and warns of others.

    Parameters
    ----------
    name : str
        Subject of the requirement.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.first: np.ndarray | None = None

    def __call__(self, value: np.ndarray) -> str:
        """Accept the value; warn if it is not the first one."""
        if self.first is None:
            self.first = value.copy()
        if not np.array_equal(value, self.first):
            caution(
                f"`{self.name}` was changed in a model that was loaded without its classes: the new value was not checked, as "
                "its check is a function of the class."
            )
        return ""


def decode_tree(data: Mapping[str, Any], decode: Decode) -> Component:
    """Return the bound model from its JSON data.

    Parameters
    ----------
    data : mapping
        From `encode_tree`.
    decode : callable
        Function from JSON data to a value.
    """
    classes = [_stand_in(entry) for entry in data["classes"]]
    components = [cls.__new__(cls) for cls in (classes[entry["class"]] for entry in data["components"])]
    for component, entry in zip(components, data["components"], strict=True):
        _fill(component, entry, components, decode)
    return components[0]


def _stand_in(entry: Mapping[str, Any]) -> type[Component]:
    """Return a stand-in class with the fields of an unknown class."""
    name, base = entry["name"], {b.__name__: b for b in BASES}[entry["base"]]
    if not name.isidentifier() or keyword.iskeyword(name):
        raise ValueError("the name of a class is invalid")
    cls: Any = type(name, (StandIn, base), {"__module__": __name__})
    cls.__doc__, cls.start_words = entry["description"], dict(entry["start_words"])
    cls.fields = {field["name"]: _field_of(field) for field in entry["fields"]}
    for own, declared in cls.fields.items():
        if not own.isidentifier() or own.startswith("_"):
            raise ValueError("the name of a field is invalid")
        if isinstance(declared, f.Observed):
            setattr(cls, own, declared)
    return cls


def _field_of(data: Mapping[str, Any]) -> f.Field:
    kind, name = KINDS[data["kind"]], data["name"]
    more = {own: data[own] for own in MORE[kind]}
    if issubclass(kind, READABLE):
        more |= {"shape": partial(_own, name, "shape"), "unit": partial(_own, name, "unit")}
    if kind is f.Structural and data["refine"]:
        more["refine"] = partial(_own, name, "refined")
    if kind is f.Observed:
        more["compute"] = partial(_computed, name)
    return kind(data["description"], name=name, **more)


def _own(name: str, what: str, component: Any) -> Any:
    return component._data[name][what]


def _computed(name: str, component: Any) -> Expr:
    data = component._data[name]
    if "refused" in data:
        raise DeclarationError(data["refused"])
    return data["value"]


def _fill(component: Any, entry: Mapping[str, Any], components: list[Any], decode: Decode) -> None:
    """Set the fields of a component."""
    data: dict[str, dict[str, Any]] = {}
    own = vars(component)
    own |= {"_path": entry["path"], "_origin": entry["where"], "_is_bound": True, "_data": data}
    own["_values"] = {name: f.InitialValue(None, True) for name in entry["started"]}
    own["_ports"] = tuple(components[k] for k in entry["ports"])
    own["_states"] = tuple(_statement(decode(statement)) for statement in entry["states"])
    if isinstance(component, Connector):
        own["_owner"] = None if entry["owner"] is None else components[entry["owner"]]
    for name, member in entry["members"].items():
        declared = type(component).fields[name]
        if isinstance(declared, READABLE):
            data[name] = {k: v if k == "refused" else _known(k, v, decode) for k, v in member.items()}
            if not isinstance(declared, f.Observed):
                own[name] = data[name]["value"]
        elif isinstance(declared, f.Structural):
            data[name], value = member, member["value"]
            own[name] = Shown(value["shown"]) if isinstance(value, dict) else value
        else:
            parts = [components[k] for k in (member if isinstance(member, list) else [member]) if k is not None]
            own[name] = parts if isinstance(member, list) else next(iter(parts), None)


def _statement(data: Any) -> Any:
    checks = not isinstance(data, Requirement) or data.problem
    return data if checks else replace(data, problem=Unchecked(str(data.subject)))


def _known(what: str, data: Any, decode: Decode) -> Any:
    if what == "value":
        return decode(data)
    return tuple(data) if isinstance(data, list) else data
