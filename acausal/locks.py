"""One thread at a time: what models share in a process is not thread-safe."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import wraps
from threading import RLock, local
from typing import ParamSpec, TypeVar

from acausal.signals import Signals

P = ParamSpec("P")
R = TypeVar("R")

# Of the whole process, not of a model: a call binds memory of its own model, but also takes the standard error stream.
LOCK = RLock()


class _Thread(local):
    """How many entries a thread is in, of which one called the next."""

    depth = 0


_THREAD = _Thread()


def _reset_in_child() -> None:
    Signals.forget()
    LOCK.release()


if hasattr(os, "register_at_fork"):
    # A child has no other threads: one that held the lock would hold it forever there.
    os.register_at_fork(before=LOCK.acquire, after_in_parent=LOCK.release, after_in_child=_reset_in_child)


def exclusive(function: Callable[P, R]) -> Callable[P, R]:
    """Let one thread at a time into all functions marked so, and no interrupt be lost in them; they may call each other.

    Parameters
    ----------
    function : callable
        An entry of the package that compiles, runs or evaluates.
    """

    @wraps(function)
    def call(*arguments: P.args, **keywords: P.kwargs) -> R:
        with LOCK, Signals():
            before, _THREAD.depth = _THREAD.depth, _THREAD.depth + 1
            try:
                return function(*arguments, **keywords)
            finally:
                _THREAD.depth = before

    return call


def unlocked(function: Callable[[], R]) -> R:
    """Call what shares nothing with other threads, which may enter meanwhile; interrupts wait, see `Signals.waiting`.

    An entry that another one called lets none in: its caller may be amid an evaluation, or have changed what is of the whole
    process.
    """
    with Signals.waiting():
        if _THREAD.depth != 1:
            return function()
        LOCK.release()
        try:
            return function()
        finally:
            LOCK.acquire()
