"""While the core integrates other threads go on: results stay the same bit by bit, and locks and interrupts are in order."""

from __future__ import annotations

import os
import signal
from concurrent.futures import ThreadPoolExecutor

import pytest

import acausal as ac
from acausal import fixed
from acausal.core import Run, run
from acausal.locks import LOCK, exclusive, unlocked
from models import CarAxis, NFourBar
from tests.acausal.solve.test_threads import TASKS, Pendulum, assert_same, read


@pytest.mark.parametrize(
    ("model", "name", "value", "options"),
    [
        *((model, name, values[0], options) for model, name, values, options in TASKS),
        (CarAxis(), "world.g", 9.0, {"stop_time": 0.5, "tolerance": 1e-4}),
        (NFourBar(), "world.g", 9.0, {"stop_time": 2.0, "tolerance": 1e-4}),
    ],
)
def test_whatever_others_do_while_the_core_integrates(monkeypatch, model, name, value, options):
    compiled, options = ac.compile(model), {"intervals": 20, "energy": True, **options}
    others = [{"parameters": {name: value}}, {"parameters": {name: value}, "method": "idas"}]
    expected = [read(ac.simulate(compiled, **{**options, **other})) for other in ({}, *others)]
    own, calls = Run.go, []

    def go(self, *arguments, **named):
        calls.append(len(calls))
        if len(calls) > 10:
            return own(self, *arguments, **named)
        with monkeypatch.context() as patch:
            patch.setattr(Run, "go", own)
            before = read(ac.simulate(compiled, **{**options, **others[0]}))
            end = own(self, *arguments, **named)
            after = read(ac.simulate(compiled, **{**options, **others[1]}))
            ac.linearize(compiled, initial="guesses")
        assert_same([before, after], expected[1:])
        return end

    monkeypatch.setattr(Run, "go", go)
    assert_same([read(ac.simulate(compiled, **options))], expected[:1])
    assert calls


def others_may_enter() -> bool:
    """Whether the lock is free for other threads."""

    def enters():
        if LOCK.acquire(blocking=False):
            LOCK.release()
            return True
        return False

    with ThreadPoolExecutor(1) as pool:
        return pool.submit(enters).result()


def watch(monkeypatch, look):
    """Let a function look on at each call of the core."""
    own = run.unlocked
    monkeypatch.setattr(run, "unlocked", lambda call: own(lambda: (look(), call())[1]))


def test_others_may_enter_while_the_core_integrates(monkeypatch):
    seen = []
    watch(monkeypatch, lambda: seen.append(others_may_enter()))
    run = {"model": Pendulum(x=fixed(1.0), v=fixed(0.0)), "stop_time": 1.0}
    ac.simulate(**run)
    assert seen == [True]
    # A caller may be amid an evaluation.
    exclusive(ac.simulate)(**run)
    assert seen == [True, False]
    assert others_may_enter()


def interrupt():
    signal.raise_signal(signal.SIGINT)


def fail():
    raise MemoryError


@pytest.mark.parametrize(("look", "error"), [(interrupt, KeyboardInterrupt), (fail, MemoryError)])
def test_the_lock_is_held_again_whatever_happens_meanwhile(monkeypatch, look, error):
    compiled, inside = ac.compile(Pendulum(x=fixed(1.0), v=fixed(0.0))), []

    @exclusive
    def run():
        try:
            unlocked(look)
        finally:
            inside.append(others_may_enter())

    with pytest.raises(error):
        run()
    with monkeypatch.context() as patch:
        watch(patch, look)
        with pytest.raises(error):
            ac.simulate(compiled, stop_time=1.0)
    assert inside == [False]
    assert others_may_enter()
    assert ac.simulate(compiled, stop_time=1.0).stats.steps > 0


def test_without_the_lock_there_is_none_to_lay_down():
    assert unlocked(others_may_enter)
    with pytest.raises(MemoryError):
        unlocked(fail)
    assert others_may_enter()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no system with fork")
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_thread_that_forks_meanwhile_takes_no_interrupts_along():
    def child():
        if pid := os.fork():
            return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            os._exit(3 if others_may_enter() else 1)
        finally:
            os._exit(2)

    with ThreadPoolExecutor(1) as pool:
        assert exclusive(lambda: unlocked(lambda: pool.submit(child).result(20)))() == 3
