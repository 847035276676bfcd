"""Interrupts are told once, however foreign code deals with them."""

from __future__ import annotations

import contextlib
import signal
from collections.abc import Iterator

import pytest

from acausal.signals import Signals


@pytest.fixture(autouse=True)
def _handler() -> Iterator[None]:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def swallowed() -> None:
    with Signals():
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        Signals.raise_lost()
        pytest.fail("the interrupt is lost")


def handled(kept: list[str]) -> None:
    with Signals():
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            Signals.raise_lost()
            try:
                raise ValueError
            except ValueError:
                Signals.raise_lost()
            kept.append("what was computed")
            raise


def test_what_was_swallowed_is_raised_before_long_work() -> None:
    with pytest.raises(KeyboardInterrupt):
        swallowed()


def test_what_is_handled_is_not_raised_again() -> None:
    kept: list[str] = []
    with pytest.raises(KeyboardInterrupt):
        handled(kept)
    assert kept


def test_what_was_swallowed_is_raised_at_the_end() -> None:
    with pytest.raises(KeyboardInterrupt), Signals(), contextlib.suppress(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
