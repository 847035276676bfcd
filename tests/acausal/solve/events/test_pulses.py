"""Comparisons with time inside of joined conditions are break times: no pulse is too short."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    atan2,
    der,
    discrete,
    exp,
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
from acausal.language.functions import tanh
from acausal.solve.events.clock_times import clock_times


class Pulses(Model):
    """What short pulses sum up to: of time alone, with a variable, negated, and counted by when()."""

    a: Scalar = parameter("begin", unit="s", default=40.013)
    b: Scalar = parameter("end", unit="s", default=40.063)
    alone: Scalar = variable("integral", start=0, fixed=True)
    mixed: Scalar = variable("integral while y is positive", start=0, fixed=True)
    either: Scalar = variable("integral where nothing is on", start=0, fixed=True)
    y: Scalar = variable("falls through 0 at 100 s", start=1, fixed=True)
    since: Scalar = variable("time since a", unit="s")
    count: Scalar = discrete("pulses")
    count_mixed: Scalar = discrete("pulses while y is positive")

    def equations(self):
        pulse = (time > self.a) & (2 * time < 2 * self.b)
        yield self.since == time - self.a
        yield der(self.y) == -0.01
        yield der(self.alone) == piecewise((1e4, pulse), 0)
        inside = (self.since > 0) & (self.y > 0) & (self.since < self.b - self.a)
        yield der(self.mixed) == piecewise((1e4, inside), 0)
        off = ~(~(time <= self.a) & (time < self.b)) | (self.y < 0)
        yield der(self.either) == piecewise((0, off), 1e4)
        yield when(pulse, reinit(self.count, self.count + 1))
        yield when(~(~pulse | (self.y < 0)), reinit(self.count_mixed, self.count_mixed + 1))


COMPILED = ac.compile(Pulses())


def run(a: float, b: float, stop: float = 150.0, **values: Any):
    return ac.simulate(COMPILED, stop_time=stop, parameters={"a": a, "b": b}, **values)


@pytest.mark.parametrize(
    ("a", "b"),
    [
        (40.013, 40.063),  # shorter than any step
        (77.77, 77.770001),
        (30.0, 30.75),  # begins and ends at outputs
        (33.0, 33.0),  # of no length
        (60.0, 50.0),  # ends before it begins
        (-1.0, 0.5),  # on at the start
        (-2.0, -1.0),  # over at the start
        (149.99, 170.0),  # on at the stop, while y is negative
        (99.95, 100.05),  # ends for the mixed ones when y becomes negative
        (110.0, 110.01),  # y is negative
        (160.0, 170.0),  # after the stop
        (0.3, 0.1 * 3),  # a rounding error long
        (25.0, 25.0 + 1e-13),
    ],
)
@pytest.mark.parametrize(("intervals", "tolerance"), [(200, 1e-6), (7, 1e-9)])
def test_no_pulse_is_missed(a, b, intervals, tolerance):
    result = run(a, b, intervals=intervals, tolerance=tolerance)
    on = max(min(b, 150.0) - max(a, 0.0), 0.0)
    positive = max(min(b, 100.0) - max(a, 0.0), 0.0)
    near = {"rtol": 1e-9, "atol": 1e5 * tolerance}
    np.testing.assert_allclose(result["alone"][-1], 1e4 * on, **near)
    np.testing.assert_allclose(result["mixed"][-1], 1e4 * positive, **near)
    np.testing.assert_allclose(result["either"][-1], 1e4 * positive, **near)
    begins = 0 < a < 150 and b - a > 1e-12 * a
    assert result["count"][-1] == begins
    assert result["count_mixed"][-1] == (begins and a < 100)


def test_pulses_at_the_start_of_a_run_that_begins_later():
    late = ac.simulate(COMPILED, start_time=40.013, stop_time=50, parameters={"a": 40.013, "b": 40.063})
    np.testing.assert_allclose([late["alone"][-1], late["mixed"][-1]], 500, rtol=1e-9)
    within = ac.simulate(COMPILED, start_time=40.063 - 1e-3, stop_time=50)
    np.testing.assert_allclose([within["alone"][-1], within["mixed"][-1]], 10, rtol=1e-8)


class Single(Model):
    """The shortest way to write a pulse."""

    a: Scalar = parameter("begin", unit="s", default=40.02)
    width: Scalar = parameter("length", unit="s", default=0.05)
    x: Scalar = variable("x", start=0, fixed=True)
    n: Scalar = discrete("n")

    def equations(self):
        yield der(self.x) == piecewise((1e4, (time > self.a) & (time < self.a + self.width)), 0)


class SingleWhen(Single):
    def equations(self):
        yield der(self.x) == 0
        yield when((time > self.a) & (time < self.a + self.width), reinit(self.n, 1), reinit(self.x, 500))


@pytest.mark.parametrize("model", [Single, SingleWhen])
@pytest.mark.parametrize("a", [40.02, 12.34, 99.9])
@pytest.mark.parametrize("width", [0.05, 1e-3, 1e-6])
def test_a_single_pulse(model, a, width):
    result = ac.simulate(model(a=a, width=width), stop_time=100)
    assert result["x"][-1] == pytest.approx(1e4 * width if model is Single else 500, rel=1e-7)


def test_break_times_are_those_of_all_comparisons():
    assert run(40.013, 40.063).stats["break_times"] == [40.013, 40.063]
    assert run(33.0, 33.0).stats["break_times"] == [33.0]
    assert run(10.0, 200.0).stats["break_times"] == [10.0]


class Overlapping(Model):
    n: Scalar = discrete("how often it became true")
    at_start: Scalar = discrete("the same, at the start as well")
    never: Scalar = discrete("never true")

    def equations(self):
        one, two = (time >= 0) & (time < 2), (time > 1) & (time < 3)
        yield when(one | two | (time > 5), reinit(self.n, self.n + 1))
        yield when(one | two | (time > 5), reinit(self.at_start, self.at_start + 1), at_start=True)
        yield when((time > 0) & (time < 0), reinit(self.never, 1), at_start=True)


def test_when_acts_where_the_whole_becomes_true():
    result = ac.simulate(Overlapping(), stop_time=8, intervals=8)
    assert result["n"].tolist() == [0, 0, 0, 0, 0, 1, 1, 1, 1]
    assert result["at_start"].tolist() == [1, 1, 1, 1, 1, 2, 2, 2, 2]
    assert not result["never"].any()


class Nonlinear(Model):
    x: Scalar = variable("time for which both hold", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == piecewise((1, (sin(time) > 0.5) & (time < 7)), 0)


def test_what_is_not_linear_in_time_is_an_event():
    result = ac.simulate(Nonlinear(), stop_time=20)
    np.testing.assert_allclose(result["x"][-1], 2 * np.pi / 3 + 7 - (2 * np.pi + np.pi / 6), atol=1e-5)
    assert result.stats["break_times"] == [7.0]
    np.testing.assert_allclose(result.stats["event_times"], [np.pi / 6, 5 * np.pi / 6, 13 * np.pi / 6], atol=1e-5)


class Curved(Model):
    """A short pulse whose condition is not linear in time, while another law breaks inside of it."""

    law: str = structural("how the pulse is written", default="square")
    a: Scalar = parameter("middle", unit="s", default=40.013)
    w: Scalar = parameter("half its length", unit="s", default=1e-4)
    x: Scalar = variable("integral of the pulse", start=0, fixed=True)
    y: Scalar = variable("integral of the other law", start=0, fixed=True)
    n: Scalar = discrete("pulses")

    def equations(self):
        off = (time - self.a) / self.w
        pulse = {
            "square": (time - self.a) ** 2 < self.w**2,
            "spread": time**2 - 2 * self.a * time + self.a**2 <= self.w**2,
            "distance": sqrt((time - self.a) ** 2) < self.w,
            "smooth distance": piecewise((off, off > 0), -off, smooth=True) < 1,
            "bell": exp(-(off**2)) > exp(-1),
            "steep": tanh(1 - off**2) > 0,
            "with a variable": (off**2 < 1) & (self.y > -1),
            "angle": atan2(off, 1) ** 2 < (np.pi / 4) ** 2,
            "inverse": 1 / (1 + off**2) > 0.5,
        }[self.law]
        yield der(self.x) == piecewise((1e4, pulse), 0)
        yield der(self.y) == piecewise((1, time < self.a), 2)
        yield when(pulse, reinit(self.n, self.n + 1))


LAWS = ("square", "spread", "distance", "smooth distance", "bell", "steep", "with a variable", "angle", "inverse")


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("a", "w"), [(40.013, 1e-4), (25.0, 1e-3), (99.9, 1e-5)])
def test_no_pulse_that_is_not_linear_in_time_is_missed(law, a, w):
    result = ac.simulate(Curved(law=law), stop_time=100, parameters={"a": a, "w": w})
    loss = 1e-16 * a**2 / (w * w) if law == "spread" else 1e-9  # what rounding leaves of its differences
    np.testing.assert_allclose(result["x"][-1], 2e4 * w, rtol=10 * loss)
    np.testing.assert_allclose(result["y"][-1], 200 - a, rtol=1e-7)
    assert result["n"][-1] == 1
    assert result.stats["break_times"] == [a]
    np.testing.assert_allclose(result.stats["event_times"], [a - w, a + w], atol=10 * loss * w)


@pytest.mark.parametrize("intervals", [1, 400])
def test_a_periodic_pulse_is_never_missed(intervals):
    class Periodic(Model):
        x: Scalar = variable("time in pulses", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == piecewise((1, sin(2 * np.pi * time) > 0.999), 0)

    result = ac.simulate(Periodic(), stop_time=100, intervals=intervals)
    np.testing.assert_allclose(result["x"][-1], 100 * (0.5 - np.arcsin(0.999) / np.pi), rtol=1e-9)
    assert result.stats["events"] == 200


def test_an_output_at_a_searched_instant_holds_the_values_after_it():
    class Shown(Model):
        u: Scalar = variable("u")

        def equations(self):
            yield self.u == piecewise((1, (time - 5) ** 2 < 1), 0)

    result = ac.simulate(Shown(), stop_time=10, intervals=10)
    assert result["u"].tolist() == [0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0]


@pytest.mark.parametrize("inclusive", [True, False])
def test_a_condition_that_is_zero_for_a_while(inclusive):
    class Flat(Model):
        x: Scalar = variable("time for which it holds", start=0, fixed=True)

        def equations(self):
            late = piecewise((time - 3.3, time > 3.3), 0, smooth=True)
            yield der(self.x) == piecewise((1, late <= 0 if inclusive else late > 0), 0)

    result = ac.simulate(Flat(), stop_time=10)
    np.testing.assert_allclose(result["x"][-1], 3.3 if inclusive else 6.7, rtol=1e-9)


def test_too_many_changes_are_told():
    class Fast(Model):
        x: Scalar = variable("x", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == piecewise((1, (sin(1e7 * time) > 0) & (time < 1e-7)), 0)

    bound = ac.compile(Fast())
    with pytest.warns(ac.AcausalWarning, match=r"(?s)Fast.*changes too often"):
        clock_times(bound, bound.parameter_values(None), 0.0, 1.0)


class Through(Model):
    """A pulse that is a variable itself, and one that a discrete variable lets through."""

    a: Scalar = parameter("begin", unit="s", default=10.0)
    pulse: Scalar = variable("1 during the pulse")
    x: Scalar = variable("while the pulse lasts", start=0, fixed=True)
    y: Scalar = variable("while the gate is open", start=0, fixed=True)
    gate: Scalar = discrete("1: open", start=1)

    def equations(self):
        on = (time > self.a) & (time < self.a + 1e-3)
        yield self.pulse == piecewise((1, on), 0)
        yield der(self.x) == piecewise((1e3, (self.pulse > 0.5) & (self.x > -1)), 0)
        yield der(self.y) == piecewise((1e3, (self.gate > 0.5) & on), 0)
        yield when((self.pulse > 0.5) & (time > 20), reinit(self.gate, 0))


def test_pulses_that_go_through_variables():
    compiled = ac.compile(Through())
    early, late = (ac.simulate(compiled, stop_time=100, parameters={"a": a}) for a in (10.0, 33.3))
    for result, open_gate in ((early, 1), (late, 0)):
        np.testing.assert_allclose([result["x"][-1], result["y"][-1]], [1, open_gate], atol=1e-6)
        assert result["gate"][-1] == open_gate


class Stop(Model):
    """A stop that is there from 1 s to 30 s, and a drive that changes twice."""

    s: Scalar = variable("position", unit="m", start=0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        touches = (self.s > 0.5) & (time < 30) & (time > 1)
        drive = piecewise((2, time < 5), (-1, (time > 6) | (self.s > 3)), 0)
        yield der(self.s) == self.v
        yield der(self.v) == piecewise((-1000 * (self.s - 0.5), touches), drive)


def test_mixed_conditions_against_segments_by_hand():
    # At 1 s the stop appears while the body is 0.5 m inside of it, and throws it out at s = 0.5.
    rate = np.sqrt(1000)
    size, phase = np.hypot(0.5, 2 / rate), np.arctan2(2 / rate, 0.5)
    out = 1 + (np.pi / 2 + phase) / rate
    speed, rest = -size * rate, 5 - out
    s5, v5 = 0.5 + speed * rest + rest**2, speed + 2 * rest
    exact = s5 + v5 * 1 + v5 * 2 - 2.0
    result = ac.simulate(Stop(), stop_time=8, tolerance=1e-9)
    np.testing.assert_allclose(result["s"][-1], exact, rtol=1e-7)
    assert result.stats["break_times"] == [1.0, 5.0, 6.0]


class Fields(Model):
    begin: Scalar = parameter("begin", unit="s", default=3.3)
    force: Scalar = ac.input("force")
    x: Scalar = variable("integral", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.force


class Pushed(Model):
    begin: Scalar = parameter("begin", unit="s", default=3.3)
    inner = Fields(force=piecewise((1e3, (time > begin) & (time < begin + 0.01)), 0))


def test_conditions_of_fields_are_joined_in_a_class_body():
    result = ac.simulate(Pushed(), stop_time=50, parameters={"begin": 7.77})
    np.testing.assert_allclose(result["inner.x"][-1], 10, rtol=1e-9)
