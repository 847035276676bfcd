"""An interrupt in a long call of an integrator keeps the rows that are there, and is never taken for a failure."""

from __future__ import annotations

import signal
import time as clock

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, fixed, output, parameter, piecewise, sin, variable

pytestmark = pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs an alarm")


class Fast(Model):
    """A fast pendulum: far more steps than outputs."""

    x: Scalar = output("angle")
    v: Scalar = variable("its rate")
    square: Scalar = parameter("square of its frequency", default=1e8)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -self.square * sin(self.x)


class Watched(Fast):
    """The same with a condition that never changes."""

    s: Scalar = output("switched")

    def equations(self):
        yield from super().equations()
        yield self.s == piecewise((1.0, self.x > 5), 2.0)


class Switched(Fast):
    """The same, after something slow, with a condition that changes after a while."""

    a: Scalar = variable("slow", start=0, fixed=True)
    s: Scalar = output("switched")

    late: Scalar = parameter("when", default=0.1)

    def equations(self):
        yield from super().equations()
        yield der(self.a) == 1
        yield self.s == piecewise((1.0, self.a > self.late), 2.0)


def interrupted(cls, after=0.7, values=None, **options):
    compiled = ac.compile(cls(x=fixed(1.0), v=fixed(0.0)), values)
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    ac.simulate(compiled, stop_time=1e-4, intervals=2, **options)
    signal.setitimer(signal.ITIMER_REAL, after)
    began = clock.perf_counter()
    try:
        with pytest.raises(KeyboardInterrupt) as caught:
            ac.simulate(compiled, stop_time=30.0, intervals=120_000, **options)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert clock.perf_counter() - began < after + 20
    return caught.value.result


@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
@pytest.mark.parametrize("cls", [Fast, Watched])
def test_rows_are_kept(cls, method):
    # So fast that the core, too, needs far longer for all rows than it is given.
    frequency = 1e5
    result = interrupted(cls, values={"square": frequency**2}, method=method)
    assert 2 < result.time.size < 120_000
    np.testing.assert_allclose(np.diff(result.time), 30.0 / 120_000, rtol=1e-6)
    assert np.all(np.isfinite(result["x"]))
    # Errors of amplitude add up over thousands of periods.
    assert np.max(np.abs(result["x"][result.time < 5e3 / frequency])) < 1.01


@pytest.mark.parametrize("method", ["idas", "rosenbrock"])
def test_what_was_done_is_counted(method):
    result = interrupted(Fast, values={"square": 1e10}, method=method)
    stats = result.stats
    assert stats.method == method
    assert stats.steps > 20 * result.time.size
    assert stats.method_steps == {method: stats.steps}
    assert stats.calls > 0
    assert stats.factorisations > 0
    assert stats.residual_evaluations > stats.steps
    assert 0.0 < stats.integration_seconds < stats.solve_seconds


def test_rows_are_those_of_a_complete_run():
    result = interrupted(Fast, method="idas")
    n = min(40, result.time.size - 1)
    whole = ac.simulate(
        ac.compile(Fast(x=fixed(1.0), v=fixed(0.0))),
        stop_time=float(result.time[n]),
        intervals=n,
        method="idas",
        tolerance=1e-9,
    )
    np.testing.assert_allclose(result["x"][: n + 1], whole["x"], atol=0.1)


@pytest.mark.parametrize("late", [1.1e-4, 0.0101])
def test_rows_beyond_a_change_of_a_condition_are_not_kept(late):
    result = interrupted(Switched, values={"late": late}, method="idas")
    assert np.array_equal(result["s"] == 1.0, result.time > late)
