"""Worker processes that do not import the script that starts them, and end with it."""

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
    """Keep processes started inside the block from importing the script again.

    Models are sent with everything they need, so a script needs no guard `if __name__ == "__main__":`.
    """
    main: Any = sys.modules["__main__"]
    with _STARTING:
        before = getattr(main, "__spec__", None)
        # multiprocessing.spawn imports nothing for a specification of this name.
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
    """Multiprocessing context that starts such processes."""

    Process = _Process


def initialise() -> None:
    """Initialise a worker: ignore interrupts, which the parent handles, and end with the parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: Any) -> None:
    wait([sentinel])
    os._exit(1)
