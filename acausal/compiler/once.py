"""Functions of a compiled model whose results are kept with it."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, Protocol, TypeVar

R = TypeVar("R")


class Compiled(Protocol):
    """Keeps what was computed from its equations."""

    kept: dict[Any, Any]


def once(function: Callable[..., R]) -> Callable[..., R]:
    """Evaluate a function of a compiled model, and of arguments that can be keys, once; its result follows from them alone.

    Parameters
    ----------
    function : callable
        Takes a compiled model first.
    """

    @wraps(function)
    def call(compiled: Compiled, *key: Hashable) -> R:
        place = (function, *key)
        if place not in compiled.kept:
            compiled.kept[place] = function(compiled, *key)
        return compiled.kept[place]

    return call


def latest(function: Callable[..., R]) -> Callable[..., R]:
    """Evaluate a function of a compiled model again only where its other arguments are not those of the last call.

    Parameters
    ----------
    function : callable
        Takes a compiled model first; its result follows from the arguments alone, and nobody changes it.
    """

    @wraps(function)
    def call(compiled: Compiled, *key: Hashable) -> R:
        if function not in compiled.kept or compiled.kept[function][0] != key:
            compiled.kept[function] = key, function(compiled, *key)
        return compiled.kept[function][1]

    return call
