"""Interrupts that come while a solver runs: solvers take what a handler raises for a failure of their own."""

from __future__ import annotations

import signal
from threading import current_thread, main_thread
from types import FrameType, TracebackType
from typing import Any

WATCHED = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGALRM") if hasattr(signal, name)]


class Signals:
    """Raises at the end of the block what a handler raised inside it, whatever became of that meanwhile."""

    def __init__(self) -> None:
        self._before: dict[int, Any] = {}
        self._caught: BaseException | None = None

    def __enter__(self) -> Signals:
        # Only the main thread runs handlers, and may set them.
        if current_thread() is main_thread():
            for number in WATCHED:
                handler = signal.getsignal(number)
                if callable(handler):
                    self._before[number] = handler
                    signal.signal(number, self._handle)
        return self

    def _handle(self, number: int, frame: FrameType | None) -> None:
        try:
            self._before[number](number, frame)
        except BaseException as error:
            self._caught = error
            raise

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)
        if self._caught is not None and error is not self._caught:
            raise self._caught from None
