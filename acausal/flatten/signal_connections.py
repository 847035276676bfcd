"""Signal connections: values of inputs of parts, and of outputs of the connecting component."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import Any

from acausal.errors import ConnectError
from acausal.flatten.field_values import DeferredInput
from acausal.flatten.origin import Origin
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.language.signal import Signal, Wire


def connected_values(
    wires: Iterable[tuple[Component, Wire, str]],
) -> list[DeferredInput]:
    """Return component, field, value and origin for each signal connection.

    Raises
    ------
    ConnectError
        A connection joins two inputs or two outputs, or an input has two values.
    """
    found: list[DeferredInput] = []
    given: dict[tuple[int, str], str] = {}
    for component, wire, where in wires:
        origin = Origin(component._path, type(component).__name__, where, f"connect({wire.a!r}, {wire.b!r})")
        target, source = _directed(component, wire, origin)
        place = (id(target.owner), target.name)
        other = given.get(place)
        if other is None and target.name in target.owner._values:
            other = f"the value that {target.owner._path} is created with"
        if other is not None:
            raise ConnectError(
                f"{origin}: `{target!r}` takes one value, but it has two, {source!r} and {other}. Remove one of them."
            )
        given[place] = repr(source)
        found.append(
            (target.owner, target.name, source.value if isinstance(source, Signal) else partial(_same, source), origin)
        )
    return found


def _directed(component: Component, wire: Wire, origin: Origin) -> tuple[Signal, Any]:
    """Return the target and the source of a signal connection."""
    takes = [_takes(component, end) for end in (wire.a, wire.b)]
    if sum(takes) != 1:
        which = "take a value" if all(takes) else "give a value"
        raise ConnectError(
            f"{origin}: `{wire.a!r}` and `{wire.b!r}` both {which}; connect an output to an input: connect(pid.y, "
            "drive.tau)."
        )
    return (wire.a, wire.b) if takes[0] else (wire.b, wire.a)


def _takes(component: Component, end: Signal | Expr) -> bool:
    """Return whether a signal takes a value: an input of a part, or an output of the component itself."""
    return isinstance(end, Signal) and (end.causality == "input") != (end.owner is component)


def _same(value: Any) -> Any:
    return value
