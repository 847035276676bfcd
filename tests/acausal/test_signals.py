"""Interrupts are raised everywhere, also where CasADi ignores them while it converts arguments."""

from __future__ import annotations

import contextlib
import signal
import sys
from collections.abc import Callable

import casadi as ca
import numpy as np
import pytest

import acausal as ac
from acausal.compiler.call import quiet
from acausal.locks import exclusive
from acausal.signals import Signals
from models.simple_pendulum import SimplePendulum

PLACES = 15
WORK: dict[str, Callable[[], object]] = {
    "compile": lambda: ac.compile(SimplePendulum()),
    "simulate": lambda: ac.simulate(SimplePendulum(), stop_time=0.1, intervals=2, energy=True)["hinge.phi"],
    "linearize": lambda: ac.linearize(SimplePendulum()),
}


@pytest.fixture(autouse=True)
def handled():
    yield
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def is_raised(work: Callable[[], object], at: int | None, seen: list[int]) -> bool:
    """Call a function with an interrupt at one of the lines that Python runs in CasADi's interface; append their number."""
    count = 0

    def trace(frame, event, _):
        nonlocal count
        if frame.f_code.co_filename != ca.casadi.__file__:
            return None
        if event == "line":
            count += 1
            if count == at:
                signal.raise_signal(signal.SIGINT)
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        work()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
        seen.append(count)
    return False


@pytest.mark.parametrize("name", WORK)
def test_interrupts_in_the_interface_of_casadi(name):
    seen: list[int] = []
    WORK[name]()
    assert not is_raised(WORK[name], None, seen)
    for at in np.linspace(1, seen[0], PLACES).astype(int):
        assert is_raised(WORK[name], int(at), seen), at


def test_a_lost_interrupt_is_raised_before_the_next_call_of_a_solver():
    went_on = []

    @exclusive
    def swallow():
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        with quiet():
            went_on.append("called")

    with pytest.raises(KeyboardInterrupt):
        swallow()
    assert not went_on
    with quiet():
        went_on.append("called")
    assert went_on


def swallowed() -> None:
    with Signals():
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        Signals.raise_lost()
        pytest.fail("the interrupt is lost")


def keeping(kept: list[str]) -> None:
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
        keeping(kept)
    assert kept


def test_what_was_swallowed_is_raised_at_the_end() -> None:
    with pytest.raises(KeyboardInterrupt), Signals(), contextlib.suppress(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def hearing(kept: list[str]) -> None:
    with Signals():
        try:
            with Signals(), quiet():
                signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            Signals.heard()
        with quiet():
            kept.append("what was computed")


def deaf_after_a_while() -> None:
    with Signals():
        for _ in range(2):
            Signals.heard()
            with contextlib.suppress(KeyboardInterrupt):
                signal.raise_signal(signal.SIGINT)
        Signals.raise_lost()
        pytest.fail("the interrupt is lost")


def deaf(raised: list[int]) -> None:
    with Signals(), Signals():
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        for place in range(3):
            try:
                Signals.raise_lost()
            except KeyboardInterrupt:
                raised.append(place)


def test_what_was_heard_is_raised_again_at_the_end_alone() -> None:
    kept: list[str] = []
    with pytest.raises(KeyboardInterrupt):
        hearing(kept)
    assert kept


def test_what_is_swallowed_after_another_one_was_heard_is_lost() -> None:
    with pytest.raises(KeyboardInterrupt):
        deaf_after_a_while()


def test_what_is_swallowed_again_is_still_lost() -> None:
    raised: list[int] = []
    with pytest.raises(KeyboardInterrupt):
        deaf(raised)
    assert raised == [0, 1, 2]
