"""Lock of the process: models share state that is not thread-safe."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import wraps
from threading import RLock, local
from typing import ParamSpec, TypeVar

from acausal.signals import Signals

P = ParamSpec("P")
R = TypeVar("R")

# One lock for the process, not for each model: calls also redirect the standard error stream.
LOCK = RLock()


class _Thread(local):
    """Nesting depth of exclusive calls in a thread."""

    depth = 0


_THREAD = _Thread()


def _reset_in_child() -> None:
    Signals.forget()
    LOCK.release()


if hasattr(os, "register_at_fork"):
    # After a fork only the forking thread exists in the child: a lock held by another thread would never be released.
    os.register_at_fork(before=LOCK.acquire, after_in_parent=LOCK.release, after_in_child=_reset_in_child)


def exclusive(function: Callable[P, R]) -> Callable[P, R]:
    """Decorate a function to run in one thread at a time, without losing interrupts; decorated functions may nest.

    Parameters
    ----------
    function : callable
        Public function that compiles, runs or evaluates models.
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


def locked(function: Callable[[], R]) -> R:
    """Call a function that shares state; interrupts are deferred, see `Signals.waiting`."""
    with Signals.waiting():
        return function()


def unlocked(function: Callable[[], R]) -> R:
    """Call a function that shares no state while the lock is released; interrupts are deferred, see `Signals.waiting`.

    In a nested exclusive call the lock stays held: the outer call may be in the middle of an evaluation, or have
    changed state of the process.
    """
    with Signals.waiting():
        if _THREAD.depth != 1:
            return function()
        LOCK.release()
        try:
            return function()
        finally:
            LOCK.acquire()
