"""Instants by the clock and by plan: beside the start, late in time, near to each other, and several at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    InitializationError,
    Model,
    Scalar,
    cos,
    der,
    discrete,
    parameter,
    piecewise,
    reinit,
    sin,
    sqrt,
    structural,
    time,
    variable,
    when,
)
from acausal.solve.integrate.integrator import Integrator

METHODS = ("auto", "idas")


class Wave(Model):
    """A mass between stops, driven by a square wave that switches at the very start."""

    shift: Scalar = parameter("of the wave", default=0)
    x: Scalar = variable("place", start=0, fixed=True)
    v: Scalar = variable("speed", start=0, fixed=True)
    hits: Scalar = discrete("number of hits")

    def equations(self):
        yield der(self.x) == self.v
        stop = piecewise((-4000 * (self.x - 0.05), self.x > 0.05), (-4000 * (self.x + 0.05), self.x < -0.05), 0)
        yield der(self.v) == piecewise((3, sin(3 * time + self.shift) > 0), -3) + stop
        yield when(self.x > 0.05, reinit(self.hits, self.hits + 1))
        yield when(self.x < -0.05, reinit(self.hits, self.hits + 1))


def run(model: Model | ac.CompiledModel, **options: Any) -> ac.Result:
    return ac.simulate(model, **({"stop_time": 3.0, "tolerance": 1e-8} | options))


@pytest.mark.parametrize("intervals", [1, 3, 400])
def test_a_law_that_switches_at_the_start(intervals: int) -> None:
    """The tiny segment before its first switch leaves no tiny step to what follows."""
    at_start, beside = run(Wave(), intervals=intervals), run(Wave(shift=1e-9), intervals=intervals)
    assert at_start["hits"][-1] == beside["hits"][-1] >= 10
    np.testing.assert_allclose(at_start.stats.event_times[-9:], beside.stats.event_times[-9:], rtol=1e-6)
    assert at_start.stats.steps == pytest.approx(beside.stats.steps, rel=0.1)


class Samplers(Model):
    """Two of them, of which every fifth instant is the same."""

    period: Scalar = parameter("of the fast one", default=0.01)
    x: Scalar = variable("state", start=0, fixed=True)
    fast: Scalar = discrete("samples")
    slow: Scalar = discrete("samples")
    due: Scalar = discrete("next fast one", start=time)
    due_slow: Scalar = discrete("next slow one", start=time)

    def equations(self):
        yield der(self.x) == cos(self.fast) - self.x
        yield when(
            time >= self.due, reinit(self.due, self.due + self.period), reinit(self.fast, self.fast + 1), at_start=True
        )
        yield when(
            time >= self.due_slow,
            reinit(self.due_slow, self.due_slow + 5 * self.period),
            reinit(self.slow, self.slow + 1),
            at_start=True,
        )


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("intervals", [1, 7, 100])
@pytest.mark.parametrize(("start", "period"), [(0.0, 1e-2), (1e5, 1e-5), (3e7, 1e-2), (1.7e9, 1e-2), (-1e6, 1e-3)])
def test_samples_of_late_runs(start: float, period: float, intervals: int, method: Any) -> None:
    """As many as of a run from 0, up to the one at the stop: rounding of the time is no part of a period."""
    found = ac.simulate(
        Samplers(),
        start_time=start,
        stop_time=start + 100 * period,
        intervals=intervals,
        method=method,
        parameters={"period": period},
    )
    assert found["fast"][-1] in (100, 101)
    assert found["slow"][-1] in (20, 21)


class Counted(Model):
    """A sample every 0.1 s, counted with the others by the run."""

    n: Scalar = discrete("samples")
    shown: Scalar = variable("the same")
    due: Scalar = discrete("next sample", start=time)

    def equations(self):
        yield self.shown == self.n
        yield when(time >= self.due, reinit(self.n, self.n + 1), reinit(self.due, self.due + 0.1), at_start=True)


class Moving(Counted):
    """With a state."""

    x: Scalar = variable("state", start=0, fixed=True)

    def equations(self):
        yield from super().equations()
        yield der(self.x) == self.n - self.x


@pytest.mark.parametrize("model", [Counted, Moving])
@pytest.mark.parametrize("start", [0.0, 1e5, 1.7e9, -1.7e9, -5.0])
@pytest.mark.parametrize("intervals", [100, 500])
def test_the_sample_at_the_stop_acts_and_counts(model: type[Model], start: float, intervals: int) -> None:
    """A sum of periods is some rounding errors of a late time away from the outputs."""
    found = ac.simulate(model(), start_time=start, stop_time=start + 10, intervals=intervals)
    assert (found["n"][-1], found.stats.events) == (101, 100)


class Tank(Model):
    """It runs empty as the root of its level, and is filled again where nothing leads on."""

    least: Scalar = parameter("level", default=1e-12)
    level: Scalar = variable("level", start=1, fixed=True)
    filled: Scalar = discrete("times")

    def equations(self):
        yield der(self.level) == -1 / sqrt(self.level)
        yield when(self.level <= self.least, reinit(self.level, 1), reinit(self.filled, self.filled + 1))


@pytest.mark.parametrize("least", [1e-12, 1e-6])
def test_what_acts_as_nothing_leads_on_acts_again(least: float) -> None:
    """level^1.5 = 1 - 1.5 t: empty every 2/3 s."""
    found = ac.simulate(Tank(), stop_time=3.4, intervals=10, parameters={"least": least})
    assert found["filled"][-1] == 5


class Idle(Model):
    """A sample that is due at 0 unless told otherwise."""

    x: Scalar = variable("state", start=0, fixed=True)
    n: Scalar = discrete("samples")
    due: Scalar = discrete("next sample")

    def equations(self):
        yield der(self.x) == self.n
        yield when(time >= self.due, reinit(self.due, self.due + 0.1), reinit(self.n, self.n + 1))


class Moved(Idle):
    """Another statement lets it act."""

    def equations(self):
        yield from super().equations()
        yield when(self.x + time > 0.5, reinit(self.due, 0.7))


class Ended(Idle):
    """It acts as a case of the law of its instant ends, or in the second of two times."""

    which: int = structural("of the two")

    def equations(self):
        yield der(self.x) == 1
        again = piecewise((2, (self.x > 0.5) & (self.x < 0.7)), 0)
        held = time >= self.due + again if self.which else (time >= self.due) & ((time < 0.5) | (time > 0.7))
        yield when(held, reinit(self.due, time + 0.1), reinit(self.n, self.n + 1))


def test_a_sample_that_can_never_act_is_told(recwarn: pytest.WarningsRecorder) -> None:
    with pytest.warns(
        ac.AcausalWarning, match=r"Idle, .*: the condition holds after the start, t = 0 s, and .* it never does"
    ):
        assert ac.simulate(Idle(), stop_time=1.0)["n"][-1] == 0
    recwarn.clear()
    assert ac.simulate(Idle(), start_time=-0.5, stop_time=1.0)["n"][-1] == 11
    assert ac.simulate(Moved(), stop_time=1.0)["n"][-1] == 4
    assert ac.simulate(Ended(which=0), stop_time=1.05)["n"][-1] == 4
    assert ac.simulate(Ended(which=1), stop_time=1.05)["n"][-1] == 4
    assert not recwarn


class Near(Model):
    """The second sampler reads what the first has set just before."""

    apart: Scalar = parameter("instants", default=4e-4)
    x: Scalar = variable("time", start=0, fixed=True)
    first: Scalar = discrete("place at the first")
    between: Scalar = discrete("way between both")
    due: Scalar = discrete("of the first", start=1)
    then: Scalar = discrete("of the second", start=1 + apart)

    def equations(self):
        yield der(self.x) == 1
        yield when(time >= self.due, reinit(self.first, self.x), reinit(self.due, self.due + 1))
        yield when(time >= self.then, reinit(self.between, self.x - self.first), reinit(self.then, self.then + 1))


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_planned_instants_are_not_met_early(tolerance: float) -> None:
    """They are 2e-8 of the run apart, and less than the tolerance."""
    found = ac.simulate(Near(), stop_time=2e4 + 0.5, intervals=10, tolerance=tolerance)
    assert found["between"][-1] == pytest.approx(4e-4, rel=1e-6)


KINDS: dict[str, Callable[[Any], Any]] = {
    "clock": lambda self: time >= 1,
    "bent clock": lambda self: time**2 >= 1,
    "plan": lambda self: time >= self.due,
}


def both(first: str, second: str) -> type[Model]:
    class Both(Model):
        x: Scalar = variable("state", start=0, fixed=True)
        n: Scalar = discrete("what both set")
        due: Scalar = discrete("instant", start=1)

        def equations(self):
            yield der(self.x) == 1
            yield when(KINDS[first](self), reinit(self.n, 1))
            yield when(KINDS[second](self), reinit(self.n, 2))

    return Both


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("second", KINDS)
@pytest.mark.parametrize("first", KINDS)
def test_two_statements_that_disagree_at_one_instant_end_a_run(first: str, second: str, method: Any) -> None:
    with pytest.raises(ac.SimulationError, match="2 statements set `n` to different values"):
        ac.simulate(both(first, second)(), stop_time=2.0, method=method)


def test_constraints_without_a_solution_on_the_way_end_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """As any other reason does: what was computed is in the error."""
    from models import FourBar

    restarted = Integrator.restarted

    def lost(self: Integrator, at: Any, moves: bool) -> Any:
        if at.time > 0.3:
            raise InitializationError("none")
        return restarted(self, at, moves)

    class Broken(FourBar):
        n: Scalar = discrete("breaks")

        def equations(self):
            yield from super().equations()
            yield when(time >= 0.5, reinit(self.n, 1))

    monkeypatch.setattr(Integrator, "restarted", lost)
    with pytest.raises(ac.SimulationError) as caught:
        ac.simulate(Broken(), stop_time=1.0)
    result: Any = caught.value.result
    assert result.time[-1] == pytest.approx(0.5, abs=0.01)
