"""Misspelt fields and settings, which Python would accept as new attributes."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterable, Iterator
from difflib import SequenceMatcher
from functools import cached_property
from types import CodeType, FunctionType
from typing import Any

from acausal.errors import PACKAGE
from acausal.language.source_code import body_reads, may_read

# Attributes that `simulate` and the command line read from a model.
SETTINGS = ("stop_time", "tolerance", "accuracy", "intervals", "initial", "method", "constraints", "max_order")
SETTABLE = ("stop_time", "method")  # settings that may also be fields
NEAR = 0.75  # least similarity ratio (difflib) of a misspelling; below it, names differ on purpose


def intended_name(cls: Any, name: str, known: Iterable[str]) -> str | None:
    """Return the known name that a similar one stands for; None if there is none, or if the class reads the given name.

    Parameters
    ----------
    cls : Component class
        The class; its body may be in execution.
    name : str
        Name that is not a field.
    known : iterable of str
        Known names.
    """
    near = [(SequenceMatcher(None, name, other).ratio(), other) for other in known if _is_near(name, other)]
    return max(near)[1] if near and not _reads(cls, name) else None


def in_own_method(component: Any, constructor: bool = False) -> bool:
    """Return whether a method or the constructor of the component is in execution: it may set plain attributes."""
    codes = set() if constructor else set(_codes(type(component)))
    frame: Any = sys._getframe(2)
    while frame is not None:
        code, values = frame.f_code, frame.f_locals
        if code.co_name == "__init__" and any(v is component for v in values.values()):
            return True
        own = code in codes and code.co_argcount > 0 and values.get(code.co_varnames[0]) is component
        if own and code.co_name != "__setattr__":
            return True
        frame = frame.f_back
    return False


def _is_near(name: str, other: str) -> bool:
    """Return whether one name is a misspelling of the other; an added suffix, number or index is intended."""
    longer = name.startswith(other) and name != other + other[-1]
    if name.isupper() or longer or (name.endswith(other) and len(name) > len(other) + 1):
        return False
    if len(name) > 2 and name.lower() == other.lower():
        return True
    (stem, _, index), (stem_other, _, index_other) = name.rpartition("_"), other.rpartition("_")
    if stem and stem == stem_other and max(len(index), len(index_other)) <= 2:
        return False
    bare, bare_other = (re.sub(r"\d", "", text) for text in (name, other))
    swapped = len(name) > 2 and sorted(name) == sorted(other)
    return bare != bare_other and (swapped or SequenceMatcher(None, name, other).ratio() >= NEAR)


def _reads(cls: Any, name: str) -> bool:
    """Return whether the class body reads a name, or a function of the class or its bases may read it."""
    codes = (code for code in _codes(cls) if not code.co_filename.startswith(PACKAGE))
    return body_reads(cls, name) or any(may_read(code, name) for code in codes)


def _codes(cls: Any) -> Iterator[CodeType]:
    """Yield the code objects of all functions in a class and its bases."""
    waiting: list[Any] = [value for base in cls.__mro__ for value in vars(base).values()]
    while waiting:
        item = waiting.pop()
        if isinstance(item, FunctionType):
            yield from (inspect.unwrap(item).__code__, item.__code__)
        elif isinstance(item, property | cached_property | staticmethod | classmethod):
            waiting += [getattr(item, name, None) for name in ("fget", "fset", "func", "__func__")]
        elif not isinstance(item, type):
            waiting += [v for k, v in getattr(item, "__dict__", {}).items() if k in _FUNCTIONS]


_FUNCTIONS = ("make", "compute", "default", "shape", "unit", "nominal", "refine")
