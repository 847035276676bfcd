"""Time limit of a run, effective even inside an integrator."""

from __future__ import annotations

import signal
import threading
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from acausal.policy import POLICY


class TooLong(Exception):
    """The time limit is exceeded."""


@contextmanager
def stopping_after(seconds: float) -> Iterator[Callable[[float, int], None]]:
    """Stop the block after some seconds; yield a function for `progress` of simulate that checks the limit as well.

    An alarm of the operating system interrupts an integrator; without alarms, or outside the main thread, the run ends at
    its next report of progress.

    Parameters
    ----------
    seconds : float
        Time limit of the block.

    Raises
    ------
    TooLong
        If the limit is exceeded.
    """
    end = clock.perf_counter() + seconds
    rung = False

    def show(fraction: float, steps: int) -> None:
        if clock.perf_counter() > end:
            raise TooLong

    def ring(*_: Any) -> None:
        nonlocal rung
        rung = True
        raise TooLong

    alarm = hasattr(signal, "setitimer") and threading.current_thread() is threading.main_thread()
    before = signal.signal(signal.SIGALRM, ring) if alarm else None
    try:
        if alarm:
            signal.setitimer(signal.ITIMER_REAL, seconds, POLICY.study.again)
        yield show
    except KeyboardInterrupt:
        if rung:  # an integrator reports every signal as an interrupt
            raise TooLong from None
        raise
    finally:
        if alarm:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)
