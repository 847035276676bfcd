"""Interrupts that come while foreign code runs, which swallows what a handler raises or takes it for its own failure."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from types import FrameType, TracebackType
from typing import Any, ClassVar

WATCHED = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGALRM") if hasattr(signal, name)]


class Signals:
    """Raises at the end of the block what a handler raised inside it, whatever became of that meanwhile.

    Solvers report it as a failure of theirs, and CasADi passes over it where it converts arguments. Blocks may be nested.
    """

    _open: ClassVar[list[Signals]] = []
    _wait: ClassVar[bool] = False

    def __init__(self) -> None:
        self._before: dict[int, Any] = {}
        self._caught: BaseException | None = None
        self._lost: BaseException | None = None  # the same, until it is known to be heard

    def __enter__(self) -> Signals:
        try:
            # Only the main thread runs handlers, and may set them.
            if current_thread() is main_thread():
                self._open.append(self)
                for number in WATCHED:
                    handler = signal.getsignal(number)
                    if callable(handler):
                        self._before[number] = handler
                        signal.signal(number, self._handle)
            return self
        except BaseException:  # interrupted here, where no end of the block follows
            self._close()
            raise

    def _close(self) -> None:
        if self in self._open:
            del self._open[self._open.index(self) :]
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        try:
            self._before[number](number, frame)
        except BaseException as error:
            self._caught = self._lost = error
            if not self._wait:
                raise

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._close()
        if self._caught is not None and error is not self._caught:
            raise self._caught from None

    @classmethod
    def raise_lost(cls) -> None:
        """Raise what a handler raised since the outermost block began: for use before work that takes long.

        What is being handled is not lost, nor what was `heard`.
        """
        for block in cls._own():
            if block._lost is not None and not _is_handled(block._lost):
                raise block._lost

    @classmethod
    def heard(cls) -> None:
        """Count nothing that a handler raised so far as lost: for who caught it and works on; blocks end with it all the same."""
        for block in cls._own():
            block._lost = None

    @classmethod
    def _own(cls) -> list[Signals]:
        """Open blocks of this thread."""
        return cls._open if current_thread() is main_thread() else []

    @classmethod
    def forget(cls) -> None:
        """Close what the main thread had open where another thread went on as a process of its own."""
        if cls._wait:
            cls._wait = False
            cls._open[0]._close()

    @classmethod
    @contextmanager
    def waiting(cls) -> Iterator[None]:
        """Raise at the end of this block, or where `raise_lost` is called in it, what handlers raise within open blocks."""
        if current_thread() is not main_thread() or cls._wait or not cls._open:
            yield
            return
        cls._wait = True
        try:
            yield
        finally:
            cls._wait = False
        cls.raise_lost()


def _is_handled(error: BaseException) -> bool:
    """Whether an exception is being handled here, or led to one that is."""
    handled = sys.exc_info()[1]
    while handled is not None and handled is not error:
        handled = handled.__context__
    return handled is error
