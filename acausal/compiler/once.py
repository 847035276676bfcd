"""Functions of a compiled model that are evaluated once for each model."""

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
