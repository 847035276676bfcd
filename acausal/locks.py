"""One thread at a time: what models share in a process is not thread-safe."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import wraps
from threading import RLock
from typing import ParamSpec, TypeVar

from acausal.signals import Signals

P = ParamSpec("P")
R = TypeVar("R")

# Of the whole process, not of a model: a call binds memory of its own model, but also takes the standard error stream.
LOCK = RLock()
if hasattr(os, "register_at_fork"):
    # A child has no other threads: one that held the lock would hold it forever there.
    os.register_at_fork(before=LOCK.acquire, after_in_parent=LOCK.release, after_in_child=LOCK.release)


def alone(function: Callable[P, R]) -> Callable[P, R]:
    """Let one thread at a time into all functions marked so, and no interrupt be lost in them; they may call each other.

    Parameters
    ----------
    function : callable
        An entry of the package that compiles, runs or evaluates.
    """

    @wraps(function)
    def call(*arguments: P.args, **keywords: P.kwargs) -> R:
        with LOCK, Signals():
            return function(*arguments, **keywords)

    return call
