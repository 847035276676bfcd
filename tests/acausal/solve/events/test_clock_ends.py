"""Conditions on time at the start, at the stop and at outputs, and instants that discrete variables plan."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, output, parameter, piecewise, reinit, sin, time, variable, when

METHODS = ("idas", "rosenbrock", "auto")


class Begun(Model):
    """x = time - t0; all conditions become true just after t0, those that are counted in `no` hold at t0."""

    t0: Scalar = parameter("start time", unit="s", default=0)
    one: Scalar = parameter("a second", unit="s", default=1)
    x: Scalar = variable("x", start=0, fixed=True)
    y: Scalar = variable("y", start=1, fixed=True)
    a: Scalar = discrete("of a variable")
    b: Scalar = discrete("of time")
    c: Scalar = discrete("joined")
    d: Scalar = discrete("of time, curved")
    e: Scalar = discrete("of a discrete variable")
    no: Scalar = discrete("what holds already")
    due: Scalar = discrete("t0", start=t0)

    def equations(self):
        yield der(self.x) == 1
        yield der(self.y) == 0
        yield when(self.x > 0, reinit(self.a, self.a + 1))
        yield when(time > self.t0, reinit(self.b, self.b + 1))
        yield when((time > self.t0) & (self.y > 0), reinit(self.c, self.c + 1))
        yield when(sin((time - self.t0) / self.one) > 0, reinit(self.d, self.d + 1))
        yield when(time > self.due, reinit(self.e, self.e + 1))
        yield when(time >= self.t0, reinit(self.no, 1))
        yield when((time >= self.t0) & (self.y > 0), reinit(self.no, 2))
        yield when((time >= self.t0) & (time < self.t0 + 9), reinit(self.no, 3))
        yield when(time >= self.due, reinit(self.no, 4))
        yield when(self.x >= 0, reinit(self.no, 5))


BEGUN = ac.compile(Begun())


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("t0", [0.0, 3.0, 0.1 * 3, -2.0])
def test_what_becomes_true_just_after_the_start_acts(method, t0):
    compiled = BEGUN if t0 == 0 else ac.compile(Begun(t0=t0))
    result = ac.simulate(compiled, start_time=t0, stop_time=t0 + 1, method=method, intervals=4)
    assert [result[name].tolist() for name in "abcde"] == [[1] * 5] * 5
    assert not result["no"].any()


class Sampled(Model):
    """x follows u, which is sampled every 0.5 s."""

    h: Scalar = parameter("period", unit="s", default=0.5)
    x: Scalar = variable("x", start=0, fixed=True)
    u: Scalar = discrete("held value")
    n: Scalar = discrete("samples")
    due: Scalar = discrete("next sample", start=h)

    def equations(self):
        yield der(self.x) == self.u - self.x
        sample = reinit(self.n, self.n + 1), reinit(self.u, 1 - self.x), reinit(self.due, self.due + self.h)
        yield when(self.condition(), *sample)

    def condition(self):
        return time >= self.due


class Scaled(Sampled):
    def condition(self):
        return 3 * time - 2 * self.due >= self.due


class Gated(Sampled):
    def condition(self):
        return (time >= self.due) & (self.x < 10)


def sampled(h: float, n: int) -> np.ndarray:
    x, u, found = 0.0, 0.0, [0.0]
    for _ in range(n):
        x = u + (x - u) * np.exp(-h)
        u = 1 - x
        found.append(x)
    return np.array(found)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-8])
@pytest.mark.parametrize("model", [Sampled, Scaled, Gated])
def test_samples(model, tolerance, method):
    result = ac.simulate(model(), stop_time=5, intervals=10, tolerance=tolerance, method=method)
    assert result["n"].tolist() == list(range(11))
    np.testing.assert_allclose(result.stats["event_times"], np.arange(1, 11) / 2, rtol=1e-14)
    np.testing.assert_allclose(result["x"], sampled(0.5, 10), atol=2 * tolerance)


@pytest.mark.parametrize("intervals", [1, 7, 30])
def test_samples_that_add_up_with_rounding(intervals):
    result = ac.simulate(Sampled(h=0.1), stop_time=3, intervals=intervals, tolerance=1e-10)
    np.testing.assert_allclose(result.stats["event_times"], np.arange(1, 31) / 10, rtol=1e-13)
    assert result["n"].tolist() == np.floor(30 * np.arange(intervals + 1) / intervals + 1e-9).tolist()
    assert result["x"][-1] == pytest.approx(sampled(0.1, 30)[-1], abs=1e-9)


class AtOnce(Sampled):
    """A sample, a break time and another plan at one instant: all take the values before it."""

    m: Scalar = discrete("what n was")
    k: Scalar = discrete("what n was as well")

    def equations(self):
        yield from super().equations()
        yield when(time >= 1, reinit(self.m, 10 + self.n))
        yield when((time > 2 * self.due - self.h - 0.5) & (self.n > 0.5), reinit(self.k, 10 + self.n))


def test_sample_at_a_break_time():
    result = ac.simulate(AtOnce(), stop_time=2, intervals=4)
    assert (result["n"].tolist(), result["m"][-1]) == ([0, 1, 2, 3, 4], 11)
    assert result.stats["event_times"] == pytest.approx([0.5, 1, 1.5, 2])


class Crowded(Sampled):
    def equations(self):
        yield der(self.x) == 0
        yield when(time >= self.due, reinit(self.due, self.due + 1e-12))


def test_samples_without_end_are_refused_or_pass():
    result = ac.simulate(Crowded(), stop_time=1)
    assert result["due"][-1] == pytest.approx(0.5, abs=1e-9)


class Ended(Model):
    """Everything at `T`: what is true at that time has happened there, what becomes true after it has not."""

    T: Scalar = parameter("when", unit="s", default=5)
    x: Scalar = variable("x", start=1, fixed=True)
    a: Scalar = discrete("of time")
    b: Scalar = discrete("after that time")
    c: Scalar = discrete("joined")
    d: Scalar = discrete("joined, after that time")
    e: Scalar = discrete("of a discrete variable")
    f: Scalar = discrete("of a discrete variable, after that time")
    due: Scalar = discrete("T", start=T)
    y: Scalar = output("law")
    z: Scalar = output("law that includes that time")

    def equations(self):
        yield der(self.x) == 0
        yield self.y == piecewise((1, time < self.T), 2)
        yield self.z == piecewise((1, (time <= self.T) & (self.x > 0)), 2)
        yield when(time >= self.T, reinit(self.a, self.a + 1))
        yield when(time > self.T, reinit(self.b, self.b + 1))
        yield when((time >= self.T) & (self.x > 0), reinit(self.c, self.c + 1))
        yield when((time > self.T) & (self.x > 0), reinit(self.d, self.d + 1))
        yield when(time >= self.due, reinit(self.e, self.e + 1))
        yield when(time > self.due, reinit(self.f, self.f + 1))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("T", "at"), [(5.0, 5.0), (0.1 * 3, 0.3), (0.3, 0.1 * 3)])
def test_chained_runs_act_once(method, T, at):
    compiled = ac.compile(Ended(T=T))
    first = ac.simulate(compiled, stop_time=at, intervals=3, method=method)
    second = ac.simulate(compiled, start_time=at, stop_time=at + 1, intervals=3, method=method)
    whole = ac.simulate(compiled, stop_time=2 * at, intervals=6, method=method)
    assert [first[name][-1] for name in "abcdef"] == [1, 0, 1, 0, 1, 0]
    assert [second[name][0] for name in "abcdef"] == [second[name][-1] for name in "abcdef"] == [0, 1, 0, 1, 0, 1]
    assert [whole[name].tolist() for name in "abcdef"] == [[0, 0, 0, 1, 1, 1, 1]] * 6
    for name in "yz":
        assert first[name].tolist() == [1, 1, 1, 2]
        assert second[name].tolist() == [2] * 4
        assert whole[name].tolist() == [1, 1, 1, 2, 2, 2, 2]
    assert first.stats["events"] == 1


class Pushed(Model):
    """A jump of the state at the stop time counts in the power balance."""

    x: Scalar = variable("x", start=1, fixed=True)

    def equations(self):
        yield der(self.x) == 0
        yield when(time >= 1, reinit(self.x, 3))

    def stored_energy(self):
        return self.x**2


def test_energy_of_a_jump_at_the_stop():
    stats = ac.simulate(Pushed(), stop_time=1, energy=True).stats
    assert (stats["energy_supplied"], stats["energy_stored_change"], stats["energy_method"]) == (8, 8, 0)
