"""Worker processes that need nothing of the script that starts them, and do not outlive it."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.machinery import ModuleSpec
from multiprocessing.connection import wait
from multiprocessing.context import SpawnContext, SpawnProcess
from threading import Lock, Thread
from typing import Any

_STARTING = Lock()


@contextmanager
def without_main() -> Iterator[None]:
    """Let processes that start inside the block not run the script again: models are sent to them with all they need.

    So a script does not need the guard `if __name__ == "__main__":`.
    """
    main: Any = sys.modules["__main__"]
    with _STARTING:
        before = getattr(main, "__spec__", None)
        # Under this name there is nothing to import, see multiprocessing.spawn.
        main.__spec__ = ModuleSpec("__main__", None)
        try:
            yield
        finally:
            main.__spec__ = before


class _Process(SpawnProcess):
    @staticmethod
    def _Popen(process_obj: Any) -> Any:
        with without_main():
            return SpawnProcess._Popen(process_obj)  # type: ignore[attr-defined]


class Workers(SpawnContext):
    """Context of multiprocessing for such processes."""

    Process = _Process


def initialise() -> None:
    """Begin a worker: interrupts are left to the process that started it, and the worker ends with that."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: Any) -> None:
    wait([sentinel])
    os._exit(1)
