"""A run that is interrupted anywhere keeps what it had computed, and that is right."""

from __future__ import annotations

import signal
import sys
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal.core import Run
from acausal.solve import run as module

SOLVER = Path(module.__file__).parent
FILES = ("events/course.py", "events/hybrid.py", "integrate/integrator.py", "integrate/trace.py")
WHERE = {str(SOLVER / name) for name in FILES}
PLACES = 25


class Bounces(ac.Model):
    """A ball that bounces."""

    h: ac.Scalar = ac.variable("height", start=1.0, fixed=True)
    v: ac.Scalar = ac.variable("speed", start=0.0, fixed=True)
    y: ac.Scalar = ac.output("twice the height")
    n: ac.Scalar = ac.discrete("bounces")

    def equations(self):
        yield ac.der(self.h) == self.v
        yield ac.der(self.v) == -9.81
        yield self.y == 2 * self.h
        yield ac.when(self.h < 0, ac.reinit(self.v, -0.8 * self.v), ac.reinit(self.n, self.n + 1))

    def validity(self):
        yield ac.expect(self.h, 1.0, 2.0, "what is looked at after a run")


class Falls(ac.Model):
    """A speed."""

    v: ac.Scalar = ac.variable("speed", start=0.0, fixed=True)

    def equations(self):
        yield ac.der(self.v) == -9.81


def interrupted(at: int | None, **how):
    """Simulate, interrupted at one line of many that Python runs in the solver; the lines and the interrupt."""
    count = 0

    def trace(frame, event, _):
        nonlocal count
        if frame.f_code.co_filename not in WHERE:
            return None
        if event == "line":
            count += 1
            if count == at:
                signal.raise_signal(signal.SIGINT)
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        ac.simulate(**how)
    except KeyboardInterrupt as interrupt:
        return count, interrupt
    finally:
        sys.settrace(before)
    return count, None


@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
@pytest.mark.parametrize("energy", [pytest.param(False, marks=pytest.mark.slow), True])
def test_interrupted_anywhere(energy, method):
    model = ac.compile(Bounces())
    how = {"model": model, "stop_time": 2.5, "intervals": 50, "method": method, "energy": energy}
    whole = ac.simulate(**how)
    lines, none = interrupted(None, **how)
    assert none is None
    kept = 0
    for at in np.linspace(1, lines, PLACES).astype(int):
        _, interrupt = interrupted(int(at), **how)
        if interrupt is None or (result := getattr(interrupt, "result", None)) is None:
            continue
        assert np.array_equal(result.time, whole.time[: len(result.time)])
        assert result.stats.steps <= whole.stats.steps
        kept += len(result.time) > 1
        for name in ("y", "n"):
            # The last row may be at an event that has not happened yet.
            rows = slice(0, len(result.time) - 1)
            np.testing.assert_allclose(result[name][rows], whole[name][rows], atol=1e-5)
    # The core passes most of the run in one line of Python.
    assert kept > 1


def test_steps_of_an_interrupted_slice_are_counted(monkeypatch):
    go = Run.go

    def cut(self, *arguments, **options):
        go(self, *arguments, **options)
        raise KeyboardInterrupt

    monkeypatch.setattr(Run, "go", cut)
    with pytest.raises(KeyboardInterrupt) as caught:
        ac.simulate(Bounces(), stop_time=2.5, method="rosenbrock")
    stats = caught.value.result.stats
    assert stats.calls > 0
    assert stats.method_steps == {"rosenbrock": stats.steps}
    assert 0 < stats.steps < stats.residual_evaluations
    assert stats.integration_seconds > 0


def test_what_an_integrator_took_to_build_is_counted(monkeypatch):
    def cut(*_, **__):
        raise KeyboardInterrupt

    compiled = ac.compile(Falls())
    monkeypatch.setattr(Run, "begin", cut)
    with pytest.raises(KeyboardInterrupt) as caught:
        ac.simulate(compiled, stop_time=2.5, method="rosenbrock")
    stats = caught.value.result.stats
    assert stats.calls == 0
    assert stats.compile_seconds > sum(compiled.seconds.values())
