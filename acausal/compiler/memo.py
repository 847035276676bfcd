"""Memoized functions of a compiled model; the model holds the results."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, Protocol, TypeVar

R = TypeVar("R")


class Compiled(Protocol):
    """An object that holds results computed from its equations."""

    @property
    def memo(self) -> dict[Any, Any]:
        """Results by function and arguments."""
        ...


def memoized(function: Callable[..., R]) -> Callable[..., R]:
    """Memoize a pure function of a compiled model and of hashable arguments.

    Parameters
    ----------
    function : callable
        Its first argument is a compiled model.
    """

    @wraps(function)
    def call(compiled: Compiled, *key: Hashable) -> R:
        place = (function, *key)
        if place not in compiled.memo:
            before, started = memo_seconds(compiled), clock.perf_counter()
            compiled.memo[place] = function(compiled, *key)
            # Nested memoized calls have added their own time meanwhile; it is part of this span.
            compiled.memo[memo_seconds] = before + clock.perf_counter() - started
        return compiled.memo[place]

    return call


def memo_seconds(compiled: Compiled) -> float:
    """Return the seconds spent on memoized results: they count as compile time, whichever run needs them first."""
    return compiled.memo.get(memo_seconds, 0.0)


def memoized_latest(calls: int) -> Callable[[Callable[..., R]], Callable[..., R]]:
    """Memoize the last results of a pure function of a compiled model; callers must not change them.

    Parameters
    ----------
    calls : int
        Number of results that are held.
    """

    def decorate(function: Callable[..., R]) -> Callable[..., R]:
        @wraps(function)
        def call(compiled: Compiled, *key: Hashable) -> R:
            known = compiled.memo.setdefault(function, {})
            if key not in known:
                result = function(compiled, *key)
                if len(known) == calls:
                    del known[next(iter(known))]
                known[key] = result
            return known[key]

        return call

    return decorate
