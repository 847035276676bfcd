"""Events: conditions on variables, jumps, stiction; compared with closed forms and an independent integration."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    SimulationError,
    der,
    discrete,
    fixed,
    output,
    parameter,
    piecewise,
    quantity,
    reinit,
    sqrt,
    time,
    variable,
    when,
)

G = 9.81


class Ball(Model):
    e: Scalar = parameter("restitution", default=0.9)
    h: Scalar = variable("height", unit="m", start=1, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -G
        yield when(self.h < 0, reinit(self.v, -self.e * self.v))

    def stored_energy(self):
        return quantity(G, "m/s2") * self.h + self.v**2 / 2


def impacts(e: float, stop: float, h: float = 1.0) -> np.ndarray:
    """Times of the impacts of a ball dropped from h."""
    times, v = [np.sqrt(2 * h / G)], np.sqrt(2 * G * h)
    while times[-1] < stop:
        v *= e
        times.append(times[-1] + 2 * v / G)
    return np.array(times[:-1])


def height(t: np.ndarray, e: float, h: float = 1.0) -> np.ndarray:
    at = np.concatenate([[-np.sqrt(2 * h / G)], impacts(e, t[-1], h)])
    k = np.searchsorted(at, t, side="right") - 1
    v = np.sqrt(2 * G * h) * e ** np.maximum(k, 0)
    return v * (t - at[k]) - G * (t - at[k]) ** 2 / 2


@pytest.mark.parametrize(("intervals", "tolerance"), [(400, 1e-6), (400, 1e-9), (7, 1e-8)])
def test_ball_bounces_at_the_exact_times(intervals, tolerance):
    result = ac.simulate(Ball(), stop_time=7.8, intervals=intervals, tolerance=tolerance, energy=True)
    exact = impacts(0.9, 7.8)
    assert result.stats["events"] == len(exact) == 23
    np.testing.assert_allclose(result.stats["event_times"], exact, atol=tolerance / 10)
    assert len(result.time) == intervals + 1
    np.testing.assert_allclose(result["h"], height(result.time, 0.9), atol=tolerance)
    lost = G * (1 - 0.9 ** (2 * len(exact)))
    assert result.stats["energy_dissipated"] == pytest.approx(lost, abs=10 * tolerance)
    assert abs(result.stats["energy_method"]) < 10 * tolerance


def test_second_run_with_other_parameters():
    compiled = ac.compile(Ball())
    for e in (0.9, 0.8, 0.95):
        result = ac.simulate(compiled, stop_time=2.5, parameters={"e": e})
        np.testing.assert_allclose(result.stats["event_times"], impacts(e, 2.5), atol=1e-8)


def test_endless_bouncing_is_refused():
    with pytest.raises(SimulationError, match=r"test_events\.py:\d+") as caught:
        ac.simulate(Ball(e=0.5), stop_time=10)
    kept: Any = caught.value.result
    rest = 3 * np.sqrt(2 / G)
    assert kept.time[-1] == pytest.approx(rest, abs=0.02)
    np.testing.assert_allclose(kept.stats["event_times"][:6], impacts(0.5, 0.99 * rest)[:6], atol=1e-7)


class Resting(Ball):
    lies: Scalar = discrete("1 when it lies")

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == piecewise((0, self.lies > 0.5), -G)
        yield when((self.h < 0) & (self.v <= -0.01), reinit(self.v, -self.e * self.v))
        yield when((self.h < 0) & (self.v > -0.01), reinit(self.v, 0), reinit(self.lies, 1))


def test_ball_comes_to_rest():
    result = ac.simulate(Resting(e=0.5), stop_time=3)
    bounces = impacts(0.5, np.sqrt(2 / G) * 3 * (1 - 1e-9))
    speed = np.sqrt(2 * G) * 0.5 ** np.arange(len(bounces))
    assert result.stats["events"] == 1 + np.sum(speed > 0.01)
    assert (result["lies"][-1], result["v"][-1]) == (1, 0)
    assert abs(result["h"][-1]) < 1e-7


class Stop(Model):
    """A mass of 1 kg that runs against a spring."""

    k: Scalar = parameter("stiffness", unit="N/m", default=400.0)
    s: Scalar = variable("position", unit="m", start=0, fixed=True)
    m: Scalar = parameter("mass", unit="kg", default=1.0)
    v: Scalar = variable("speed", unit="m/s", start=2, fixed=True)
    f: Scalar = output("force", unit="N")

    def equations(self):
        yield self.v == der(self.s)
        yield self.f == piecewise((-self.k * (self.s - 1.0), self.s > 1.0), 0)
        yield self.m * der(self.v) == self.f

    def stored_energy(self):
        return self.m * self.v**2 / 2 + piecewise((self.k * (self.s - 1.0) ** 2 / 2, self.s > 1.0), 0)


def test_limit_stop_in_both_directions():
    result = ac.simulate(Stop(), stop_time=1.2, tolerance=1e-9, energy=True)
    t, w = result.time, 20.0
    leave = 0.5 + np.pi / w
    np.testing.assert_allclose(result.stats["event_times"], [0.5, leave], atol=1e-8)
    touching = 1 + 2 / w * np.sin(w * (t - 0.5))
    exact = np.where(t < 0.5, 2 * t, np.where(t < leave, touching, 1 - 2 * (t - leave)))
    np.testing.assert_allclose(result["s"], exact, atol=1e-7)
    assert abs(result.stats["energy_stored_change"]) < 1e-7


def test_start_in_contact_and_linearisation_there():
    class Inside(Stop):
        s: Scalar = variable("position", unit="m", start=1.1, fixed=True)

    assert ac.linearize(Inside()).frequencies_hz == pytest.approx([20 / (2 * np.pi)])
    assert ac.linearize(Stop()).frequencies_hz.size == 0
    assert ac.simulate(Inside(), stop_time=1).stats["events"] == 1


class Ramp(Model):
    """x rises at rate 1; something happens at x = 0.5."""

    x: Scalar = variable("x", start=0, fixed=True)
    y: Scalar = variable("y", start=0, fixed=True)
    rate: Scalar = output("rate")

    def equations(self):
        yield der(self.x) == 1
        yield self.rate == piecewise((1, self.x < 0.5), -3)
        yield der(self.y) == self.rate


@pytest.mark.parametrize("intervals", [1, 2, 10, 40])
def test_crossing_on_an_output_reports_the_value_after(intervals):
    result = ac.simulate(Ramp(), stop_time=1.0, intervals=intervals)
    t = result.time
    assert result.stats["event_times"] == pytest.approx([0.5], abs=1e-7)
    np.testing.assert_array_equal(result["rate"], np.where(t < 0.5, 1, -3))
    np.testing.assert_allclose(result["y"], np.where(t < 0.5, t, 0.5 - 3 * (t - 0.5)), atol=1e-6)


class Dip(Model):
    """y = (t - 0.55)^2 is below `depth` for a short time only."""

    depth: Scalar = parameter("depth", default=1e-4)
    y: Scalar = variable("y", start=0.55**2, fixed=True)
    below: Scalar = variable("time below", start=0, fixed=True)

    def equations(self):
        yield der(self.y) == 2 * (time - 0.55)
        yield der(self.below) == piecewise((1, self.y < self.depth), 0)


@pytest.mark.parametrize("intervals", [1, 2, 9])
def test_two_crossings_between_two_outputs(intervals):
    result = ac.simulate(Dip(), stop_time=1.0, intervals=intervals, tolerance=1e-9)
    assert result.stats["event_times"] == pytest.approx([0.54, 0.56], abs=1e-6)
    assert result["below"][-1] == pytest.approx(0.02, abs=1e-6)


class Oscillation(Model):
    x: Scalar = variable("x", start=0.3, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)
    n: Scalar = discrete("number of half oscillations")

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -((40 * np.pi) ** 2) * self.x
        yield when(self.x < 0, reinit(self.n, self.n + 1))
        yield when(self.x > 0, reinit(self.n, self.n + 1))


def test_all_crossings_of_an_oscillation_much_faster_than_the_outputs():
    result = ac.simulate(Oscillation(), stop_time=1.0, intervals=4, tolerance=1e-7)
    assert result["n"][-1] == result.stats["events"] == 40
    np.testing.assert_allclose(result.stats["event_times"], (np.arange(40) + 0.5) / 40, atol=1e-5)


class Sawtooth(Model):
    """Rises at rate 1 and falls to 0 at every second."""

    x: Scalar = variable("x", start=0, fixed=True)
    n: Scalar = discrete("number of falls")

    def equations(self):
        yield der(self.x) == 1
        yield when(self.x > 1, reinit(self.x, 0), reinit(self.n, self.n + 1))


def test_many_events_that_are_all_at_outputs():
    result = ac.simulate(Sawtooth(), stop_time=150, intervals=150)
    assert result["n"][-2] == 149
    np.testing.assert_allclose(result.stats["event_times"][:149], np.arange(1, 150), atol=1e-6)


class Pair(Model):
    first = Ball()
    second = Ball(e=0.7)


def test_guards_at_the_same_time():
    result = ac.simulate(Pair(), stop_time=1.0, tolerance=1e-9)
    exact = np.unique(np.concatenate([impacts(0.9, 1.0), impacts(0.7, 1.0)]))
    np.testing.assert_allclose(result.stats["event_times"], exact, atol=1e-9)
    for name, e in (("first", 0.9), ("second", 0.7)):
        np.testing.assert_allclose(result[f"{name}.h"], height(result.time, e), atol=1e-8)


class Dropped(Ball):
    h: Scalar = variable("height", unit="m", start=0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=-2, fixed=True)


def test_event_function_that_starts_at_zero():
    result = ac.simulate(Dropped(), stop_time=0.3)
    np.testing.assert_allclose(result["h"], 1.8 * result.time - G * result.time**2 / 2, atol=1e-7)
    rising = ac.simulate(Dropped(v=fixed(2)), stop_time=0.6)
    assert rising.stats["event_times"] == pytest.approx([4 / G], abs=1e-7)


class Tank(Model):
    """Outflow by Torricelli's law; beyond empty the root has no value."""

    h: Scalar = variable("level", start=1, fixed=True)

    def equations(self):
        yield der(self.h) == piecewise((-sqrt(self.h), self.h > 0), 0)


def test_law_without_a_value_beyond_the_event():
    result = ac.simulate(Tank(), stop_time=3.0, tolerance=1e-8)
    np.testing.assert_allclose(result["h"], np.maximum(1 - result.time / 2, 0) ** 2, atol=1e-6)


class Clocked(Model):
    x: Scalar = variable("x", start=1, fixed=True)
    due: Scalar = discrete("next time", start=0.25)

    def equations(self):
        yield der(self.x) == -self.x
        yield when(time >= 0.6, reinit(self.x, 2))
        yield when(time >= self.due, reinit(self.due, self.due + 0.25), reinit(self.x, self.x + 1))


def test_events_by_the_clock():
    result = ac.simulate(Clocked(), stop_time=0.8, intervals=8, tolerance=1e-9)
    assert result.stats["break_times"] == [0.6]
    assert result.stats["event_times"] == pytest.approx([0.25, 0.5, 0.75], abs=1e-8)
    q, r = np.exp(-0.25), np.exp(-0.15)
    assert result["x"][5:7] == pytest.approx([(q + 1) * q + 1, 2.0], abs=1e-7)
    assert result["x"][-1] == pytest.approx((2 * r + 1) * np.exp(-0.05), abs=1e-7)
    assert result["due"][-1] == 1.0


class Ringing(Model):
    """A slow motion with an event, beside a vibration that the outputs cannot show."""

    slow: Scalar = variable("slow", start=1, fixed=True)
    mode: Scalar = discrete("how often it passed 0", start=0)
    x: Scalar = variable("fast", start=1e-3, fixed=True)
    v: Scalar = variable("its rate", start=0, fixed=True)
    rate: Scalar = variable("rate of the slow motion", start=0, fixed=True)

    def equations(self):
        yield der(self.slow) == self.rate
        yield der(self.rate) == -(10.0**2) * self.slow + self.x
        yield when(self.slow < 0, reinit(self.mode, self.mode + 1))
        yield der(self.x) == self.v
        yield der(self.v) == -(1e4**2) * self.x


@pytest.mark.parametrize(("method", "used"), [("auto", "rosenbrock"), ("resolve", "idas")])
def test_vibrations_beside_events_are_damped_where_outputs_cannot_show_them(method, used):
    result = ac.simulate(Ringing(), stop_time=0.2, tolerance=1e-6, intervals=40, method=method)
    assert used in result.stats["method"]
    np.testing.assert_allclose(result.stats["event_times"], [np.pi / 20], rtol=1e-5)
    np.testing.assert_allclose(result["slow"], np.cos(10 * result.time), atol=1e-4)
