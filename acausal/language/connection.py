"""Statements of connections(): connections, and branches and roots of over-determined records."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from acausal.errors import ConnectError
from acausal.language.call_arguments import checked_call
from acausal.language.component import Component, Connector
from acausal.language.expression import Expr
from acausal.language.fields import Field
from acausal.language.path import Path
from acausal.language.pending import PENDING
from acausal.language.signal import Signal, Wire

OPTIONAL = "An optional port is None unless its option is set, such as Revolute(use_axis_flange=True)."


@dataclass(frozen=True, eq=False)
class Connect:
    """Connection of two ports."""

    a: Connector
    b: Connector


@dataclass(frozen=True, eq=False)
class Branch:
    """Relation between the records of two connectors of a component, stated by its equations."""

    a: Connector
    b: Connector


@dataclass(frozen=True, eq=False)
class Root:
    """Connector whose record the component defines; always if the priority is None, else if it is chosen."""

    connector: Connector
    priority: int | None = None


@checked_call
def connect(a: Any, b: Any) -> Connect | Wire:
    """Connect two ports: potentials become equal, flows sum to zero. Or connect an output to an input.

    Raises
    ------
    ConnectError
        If an argument is neither a port nor a signal, or the classes differ.
    """
    if any(isinstance(end, Signal) for end in (a, b)) and all(isinstance(end, Signal | Expr) for end in (a, b)):
        return Wire(a, b)
    for port in (a, b):
        _port(port, "connect")
    if type(a) is not type(b):
        raise ConnectError(
            f"{_describe(a)} and {_describe(b)} cannot be connected: a port connects only to a port of its own class."
        )
    if a is b:
        raise ConnectError(f"{_describe(a)} is connected to itself.")
    return Connect(a, b)


@checked_call
def chain(*items: Any) -> list[Connect | Wire]:
    """Connect the second end of each part to the first end of the next one.

    Parameters
    ----------
    *items : Component or Connector
        Parts in order; a port may replace a part.
    """
    if len(items) < 2:
        raise ConnectError("chain() joins at least two parts.")
    for place, item in enumerate(items, 1):
        _check_link(item, place)
    return [connect(_end(left, 1), _end(right, 0)) for left, right in pairwise(items)]


@checked_call
def branch(a: Any, b: Any) -> Branch:
    """State that the component relates the over-determined records of two of its connectors."""
    return Branch(_port(a, "branch"), _port(b, "branch"))


@checked_call
def root(connector: Any) -> Root:
    """State that the component defines the over-determined record of this connector."""
    return Root(_port(connector, "root"))


@checked_call
def potential_root(connector: Any, priority: int = 0) -> Root:
    """State that the connector can be a root if no other root is reached; the lowest priority is chosen first."""
    return Root(_port(connector, "potential_root"), priority)


@checked_call
def is_root(connector: Any) -> bool:
    """Return, in equations(), whether the connector was chosen as a root."""
    return connector._is_root


@checked_call
def rooted(a: Any, b: Any | None = None) -> bool:
    """Return, in equations(), whether `a` is nearer to the root than `b`, or than the other end of its branch."""
    if b is not None:
        return a in b._parents
    return not any(parent._owner is a._owner for parent in a._parents)


@checked_call
def connected(port: Any) -> tuple[Component, ...]:
    """Return, in equations() and validity(), the other components whose ports are connected to a port."""
    owners = (other._owner for other in port._set if other._owner is not port._owner)
    return tuple(owner for owner in owners if owner is not None)


@checked_call
def in_loop(component: Any) -> bool:
    """Return, in equations(), whether the component is part of a closed loop of over-determined records."""
    return component._in_loop


def _port(item: Any, word: str) -> Connector:
    """Return a port of a built model, or raise ConnectError."""
    _refuse_unbuilt(item)
    if not isinstance(item, Connector):
        what = {"connect": "joins two ports", "branch": "relates two ports"}.get(word, "takes a port")
        raise ConnectError(
            f"{word}() {what}, but {'None is given' if item is None else f'{_describe(item)} is not a port'}. "
            f"{_ports_of(item)}"
        )
    return item


def _refuse_unbuilt(item: Any) -> None:
    """Raise ConnectError for a part, or a port of a part, that is not in a built model."""
    loose = isinstance(item, Path | Field) or (isinstance(item, Component) and not item._is_bound)
    if loose and PENDING.get(None) is None:
        raise ConnectError(
            "ports are joined in connections(), not in the class body: "
            "`def connections(self): yield connect(self.a.frame_b, self.b.frame_a)`."
        )
    if isinstance(item, Component) and not item._is_bound:
        name, kind = type(item).__name__.lower(), type(item).__name__
        raise ConnectError(
            f"{kind}() is created in connections(), where it does not become a part of the model. Declare it in the "
            f"class body, `{name} = {kind}(...)`, and connect self.{name}."
        )
    if isinstance(item, type) and issubclass(item, Component):
        name = item.__name__.lower()
        raise ConnectError(
            f"{item.__name__} is a class, not a part of this model. Write a part in the class body, "
            f"`{name} = {item.__name__}(...)`, and connect self.{name}."
        )
    if isinstance(item, Field):
        raise ConnectError(
            f"`{item.name}` is read from a class, not from a part of this model. Write the part in the class body, "
            f"`part = ...`, and connect self.part.{item.name}."
        )
    if isinstance(item, Path):
        raise ConnectError(
            f"`{item}` belongs to a component that is not part of this model. Write that component in the class body, "
            f"`part = ...`, and connect self.part.{item}."
        )


def _check_link(item: Any, place: int) -> None:
    """Raise ConnectError for an argument of chain() that is neither a part nor a port; `place` counts from 1."""
    _refuse_unbuilt(item)
    if isinstance(item, list | tuple):
        raise ConnectError(
            "chain() joins parts and ports, not lists of them: write chain(self.a, *self.links, self.b)."
        )
    if item is None:
        raise ConnectError(
            f"chain() joins parts and ports, but argument {place} is None. {OPTIONAL} Leave None out of the chain: "
            "`if self.part is not None: yield chain(...)`."
        )
    if not isinstance(item, Component):
        raise ConnectError(f"chain() joins parts and ports, but argument {place}, {item!r}, is neither.")


def _end(item: Component, which: int) -> Any:
    if isinstance(item, Connector):
        return item
    name = type(item).ends[which]
    end = getattr(item, name, None) if name else None
    if end is None:
        side = ("first", "second")[which]
        raise ConnectError(f"{_describe(item)} has no {side} end for chain(). {_ports_of(item)}")
    return end


def _describe(item: Any) -> str:
    return f"{item._path or 'the model'} ({type(item).__name__})" if isinstance(item, Component) else repr(item)


def _ports_of(item: Any) -> str:
    if item is None:
        return OPTIONAL
    ports = item._ports if isinstance(item, Component) else ()
    return "Its ports: " + ", ".join(p._path for p in ports) + "." if ports else "Name one of a part's ports."
