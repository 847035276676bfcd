"""Diagnosis of models that cannot be pickled: find the open file, lock or generator inside."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from typing import Any

from acausal.language.fields import Template
from acausal.language.value_checks import shown_or_kind

DEEP = 6  # depth of the search through nested values


def unsendable(value: Any, sends: Callable[[Any], bool], name: str = "") -> str:
    """Describe the innermost value that cannot be pickled and its place; "" if none is found.

    Parameters
    ----------
    value : object
        A model, a function or values that cannot be pickled.
    sends : callable
        Returns whether a value can be pickled.
    name : str
        Name of the value.
    """
    found, seen = "", set[int]()
    for _ in range(DEEP):
        seen.add(id(value))
        inner = next(((n, v) for n, v in _held(value, name) if id(v) not in seen and not sends(v)), None)
        if inner is None:
            break
        name, value = inner
        found = f"`{name}` is {shown_or_kind(value)}"
    return found


def _held(value: Any, name: str) -> Iterator[tuple[str, Any]]:
    """Yield the values inside a value, each with its name."""
    start = f"{name}." if name else ""
    if isinstance(value, Template):
        for own, inner in {**vars(value), **getattr(value, "_values", {})}.items():
            if not own.startswith("_"):
                yield start + own, inner
        yield from _held(type(value), name)
    elif isinstance(value, dict):
        yield from ((f"{name}[{key!r}]", inner) for key, inner in value.items())
    elif isinstance(value, list | tuple):
        yield from ((f"{name}[{k}]", inner) for k, inner in enumerate(value))
    elif isinstance(value, type):
        for own, inner in ((n, v) for base in value.__mro__ for n, v in vars(base).items()):
            if not own.startswith("_"):
                yield start + own, inner
    elif inspect.isroutine(value) or inspect.isfunction(getattr(value, "__func__", None)):
        function = inspect.unwrap(getattr(value, "__func__", value))
        if inspect.isfunction(function):
            names = inspect.getclosurevars(function)
            outside = {**names.nonlocals, **names.globals}.items()
            yield from ((own, inner) for own, inner in outside if not own.startswith("__"))
    elif hasattr(value, "__dict__"):
        yield from ((f"{start}{own}", inner) for own, inner in vars(value).items())
