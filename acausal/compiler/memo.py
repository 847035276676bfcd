"""Functions of a compiled model whose results are kept with it."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, Protocol, TypeVar

R = TypeVar("R")


class Compiled(Protocol):
    """Keeps what was computed from its equations."""

    @property
    def kept(self) -> dict[Any, Any]:
        """Results by function and arguments."""
        ...


def memoized(function: Callable[..., R]) -> Callable[..., R]:
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
            before, started = memo_seconds(compiled), clock.perf_counter()
            compiled.kept[place] = function(compiled, *key)
            compiled.kept[memo_seconds] = (
                before + clock.perf_counter() - started
            )  # what it made by others of its kind among it
        return compiled.kept[place]

    return call


def memo_seconds(compiled: Compiled) -> float:
    """Return how many seconds went into results that are kept for good: they belong to compiling, whichever run needs them."""
    return compiled.kept.get(memo_seconds, 0.0)


def memoized_latest(calls: int) -> Callable[[Callable[..., R]], Callable[..., R]]:
    """Evaluate a function of a compiled model again only where its other arguments are none of those of the last results.

    Parameters
    ----------
    calls : int
        How many results are kept. The function takes a compiled model first; its result follows from the arguments alone, and
        nobody changes it.
    """

    def decorate(function: Callable[..., R]) -> Callable[..., R]:
        @wraps(function)
        def call(compiled: Compiled, *key: Hashable) -> R:
            known = compiled.kept.setdefault(function, {})
            if key not in known:
                result = function(compiled, *key)
                if len(known) == calls:
                    del known[next(iter(known))]
                known[key] = result
            return known[key]

        return call

    return decorate
