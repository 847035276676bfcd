"""Scheduled events of sampled controllers, against runs by another method."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import (
    Model,
    Scalar,
    connect,
    der,
    discrete,
    fixed,
    output,
    parameter,
    piecewise,
    reinit,
    time,
    variable,
    when,
)
from acausal.compiler import CompiledModel
from acausal.core import run as core
from acausal.core.run import Run
from components import Revolute
from components.rotational import Torque
from models import FlexiblePendulum, FourBar, SliderCrank
from tests.benchmarks.events.scenes import SampledPendulum
from tests.shared import pairwise


class Plant(Model):
    """Mass on a spring, with a force that is set at instants."""

    stop_time = 0.7
    period: Scalar = parameter("between two samples", default=0.01)
    u: Scalar = discrete("force")
    due: Scalar = discrete("time of the next sample")
    q: Scalar = variable("place", start=1, fixed=True)
    v: Scalar = variable("speed", start=0, fixed=True)
    f: Scalar = variable("force of the spring", start=1)
    shown: Scalar = output("place")

    def equations(self):
        yield self.v == der(self.q)
        yield self.f + 0.1 * self.f**3 == -9 * self.q - 0.2 * self.v
        yield der(self.v) == self.f + self.u
        yield self.shown == self.q
        yield from self.sampling()

    def stored_energy(self):
        return self.v**2 / 2

    def supplied_power(self):
        return (self.u + self.f + 0.2 * self.v) * self.v

    def dissipated_power(self):
        return 0.2 * self.v**2

    def sampling(self):
        yield when(
            time >= self.due, reinit(self.u, -2 * self.v), reinit(self.due, self.due + self.period), at_start=True
        )


class Uneven(Plant):
    """The next sample is the sooner the faster it moves."""

    def sampling(self):
        pause = self.period / (1 + self.v**2)
        yield when(time >= self.due, reinit(self.u, -2 * self.f), reinit(self.due, time + pause), at_start=True)


class TwoRates(Plant):
    """Two clocks, of which some instants are the same."""

    w: Scalar = discrete("slow part")
    slow: Scalar = discrete("time of the next slow sample")

    def sampling(self):
        yield when(time >= self.due, reinit(self.u, self.w - self.v), reinit(self.due, self.due + 0.01), at_start=True)
        yield when(time >= self.slow, reinit(self.w, 9 - self.f), reinit(self.slow, self.slow + 0.03), at_start=True)


class Switching(Plant):
    """Between samples it passes a stop, and a counter counts that."""

    n: Scalar = discrete("number of passages")

    def sampling(self):
        yield from Plant.sampling(self)
        yield when(self.q < -0.2, reinit(self.n, self.n + 1))
        yield when(self.q > piecewise((0.3, self.v > 0), 0.2), reinit(self.v, 0.9 * self.v))


class Kicked(Plant):
    """Every sample, a state jumps."""

    due: Scalar = discrete("time of the next sample", start=0.01)

    def sampling(self):
        yield when(time >= self.due, reinit(self.v, self.v - 0.01 * self.q), reinit(self.due, self.due + self.period))


class Stopping(Plant):
    """After half a second, nothing is planned any more."""

    def sampling(self):
        following = piecewise((self.due + self.period, self.due < 0.5), 1e9)
        yield when(time >= self.due, reinit(self.u, self.q), reinit(self.due, following), at_start=True)


class Quantised(Plant):
    """The force has steps, and is the same at many samples."""

    def sampling(self):
        level = piecewise((1, self.q < -0.3), (-1, self.q > 0.3), 0)
        yield when(time >= self.due, reinit(self.u, level), reinit(self.due, self.due + self.period), at_start=True)


class Pulsed(Plant):
    """A pulse by the clock between the samples."""

    def sampling(self):
        on = piecewise((0.5, time < 0.2037), (0, time < 0.5), 1)
        yield when(
            time >= self.due, reinit(self.u, on - self.v), reinit(self.due, self.due + self.period), at_start=True
        )


class Loop(FourBar):
    """A controller drives the crank of a closed loop."""

    stop_time = 0.4
    u: Scalar = discrete("torque", unit="N.m")
    due: Scalar = discrete("time of the next sample", unit="s")
    gain: Scalar = parameter("torque over speed", unit="N.m.s", default=5)
    motor = Torque()

    def connections(self):
        yield from super().connections()
        yield connect(self.motor.flange, self.j1.axis)

    def equations(self):
        yield from super().equations()
        yield self.motor.tau == self.u
        torque = self.gain * (3 - self.j1.w)
        yield when(time >= self.due, reinit(self.u, torque), reinit(self.due, self.due + 0.01), at_start=True)


class Beam(FlexiblePendulum):
    """A controller brakes a beam that rings: between two samples there may be more steps than are taken at one go."""

    stop_time = 0.3
    u: Scalar = discrete("torque", unit="N.m")
    due: Scalar = discrete("time of the next sample", unit="s")
    gain: Scalar = parameter("torque over speed", unit="N.m.s", default=0.01)
    hinge, motor = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0)), Torque()

    def connections(self):
        yield from super().connections()
        yield connect(self.motor.flange, self.hinge.axis)

    def equations(self):
        yield from super().equations()
        yield self.motor.tau == self.u
        torque = -self.gain * self.hinge.w
        yield when(time >= self.due, reinit(self.u, torque), reinit(self.due, self.due + 0.01), at_start=True)


MODELS = (Beam, Loop, Plant, Uneven, TwoRates, Switching, Kicked, Stopping, Quantised, Pulsed)


@cache
def compiled(model: type[Model]) -> CompiledModel:
    return ac.compile(model())


def both(model: type[Model], **options: Any) -> tuple[ac.Result, ac.Result]:
    """Return a run, and the same to nine digits: by IDAS, except for the beam, whose vibrations that damps."""
    exact = {**options, "method": "auto" if model is Beam else "idas", "tolerance": 1e-9}
    return ac.simulate(compiled(model), **options), ac.simulate(compiled(model), **exact)


@pytest.mark.parametrize(("model", "tolerance", "method"), pairwise(MODELS[1:], [1e-3, 1e-6], ["auto", "rosenbrock"]))
def test_values_and_events_are_those_of_the_other_method(model: type[Model], tolerance: float, method: str) -> None:
    """All but the beam, whose vibrations are damped."""
    tolerance = min(tolerance, 1e-5) if model is Quantised else tolerance  # a quantum is larger than an error
    one, other = both(model, tolerance=tolerance, method=method, intervals=70)
    assert one.stats.events == other.stats.events > 0
    np.testing.assert_allclose(one.stats.event_times, other.stats.event_times, rtol=tolerance, atol=tolerance)
    for name in one:
        scale = np.max(np.abs(np.nan_to_num(other[name], posinf=0)), initial=1e-3)
        np.testing.assert_allclose(one[name], other[name], rtol=0, atol=10 * tolerance * scale, err_msg=name)


@pytest.mark.parametrize("intervals", [1, 7, 210, 3000])
def test_outputs_at_and_between_instants(intervals: int) -> None:
    one, other = both(Plant, intervals=intervals, tolerance=1e-8)
    np.testing.assert_array_equal(one.time, other.time)
    for name in one:
        np.testing.assert_allclose(one[name], other[name], rtol=0, atol=1e-6, err_msg=name)


def test_it_is_taken(monkeypatch: Any) -> None:
    """All instants but the last one before each end are passed in a few calls."""
    passed = []
    go = Run.go

    def counted(*arguments: Any, **options: Any) -> Any:
        passed.append(go(*arguments, **options))
        return passed[-1]

    monkeypatch.setattr(Run, "go", counted)
    found = ac.simulate(compiled(SampledPendulum), stop_time=1.0)
    assert sum(len(rows.events) for rows in passed) >= found.stats.events - 5
    assert len(passed) < 10


def test_a_stop_between_samples_is_found_at_its_time() -> None:
    """The controller rests, so that the motion is known: with a force of 0 the counter counts passages of a spring."""

    class Free(Switching):
        def equations(self):
            yield self.v == der(self.q)
            yield self.f == -9 * self.q
            yield der(self.v) == self.f + self.u
            yield self.shown == self.q
            yield when(time >= self.due, reinit(self.u, 0), reinit(self.due, self.due + self.period), at_start=True)
            yield when(self.q < -0.2, reinit(self.n, self.n + 1))

    found = ac.simulate(Free(), tolerance=1e-8, stop_time=3.0)
    passages = (np.arccos(-0.2) + 2 * np.pi * np.arange(2)) / 3
    times = np.array(found.stats.event_times)
    for passage in passages:
        assert np.min(np.abs(times - passage)) < 1e-7
    assert found["n"][-1] == 2


class Excursions(Plant):
    """What is sampled swings beyond a level now and then, for a short time, which a counter counts."""

    rate: Scalar = parameter("angular frequency", default=30)
    level: Scalar = parameter("level", default=0.9)
    n: Scalar = discrete("number of excursions")
    a: Scalar = variable("angle", start=0, fixed=True)

    def sampling(self):
        yield der(self.a) == self.rate * (1 + 0.1 * self.q)
        yield when(time >= self.due, reinit(self.u, -self.v), reinit(self.due, self.due + self.period), at_start=True)
        yield when(ac.sin(self.a) > self.level, reinit(self.n, self.n + 1))


@pytest.mark.parametrize("seed", range(12))
def test_no_excursion_is_missed(seed: int) -> None:
    random = np.random.default_rng(seed)
    level = 1 - 10.0 ** random.uniform(-6, -0.5)
    given = {"rate": random.uniform(5, 80), "level": level, "period": random.uniform(0.005, 0.05)}
    one, other = both(Excursions, parameters=given, tolerance=1e-6)
    turns = (one["a"][-1] - np.arcsin(level)) / (2 * np.pi)
    assert one["n"][-1] == other["n"][-1] == np.floor(turns) + 1
    np.testing.assert_allclose(one.stats.event_times, other.stats.event_times, rtol=0, atol=1e-5)


def test_samples_are_no_reason_to_warn(recwarn: pytest.WarningsRecorder) -> None:
    """Twenty thousand events take a second."""
    found = ac.simulate(compiled(SampledPendulum), stop_time=10.0, parameters={"period": 5e-4})
    assert found.stats.events == 20_000
    assert not [str(w.message) for w in recwarn if "events up to" in str(w.message)]


def test_interrupted_between_instants(monkeypatch: Any) -> None:
    """What was passed before Ctrl-C is kept."""
    go, calls = Run.go, []

    def interrupted(*arguments: Any, **options: Any) -> Any:
        calls.append(1)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return go(*arguments, **options)

    monkeypatch.setattr(Run, "go", interrupted)
    with pytest.raises(KeyboardInterrupt) as caught:
        ac.simulate(compiled(SampledPendulum), stop_time=3.0)
    result: Any = caught.value.result
    assert 0.5 < result.time[-1] < 2.5
    assert result.stats.stopped == "interrupted"


def test_what_was_done_before_an_interrupt_is_counted(monkeypatch: Any) -> None:
    def cut(go: Any) -> None:
        go()
        raise KeyboardInterrupt

    monkeypatch.setattr(core, "unlocked", cut)
    with pytest.raises(KeyboardInterrupt) as caught:
        ac.simulate(compiled(SampledPendulum), stop_time=3.0)
    stats: Any = caught.value.result.stats
    assert stats.calls > 10
    assert stats.calls < stats.steps < stats.residual_evaluations


def test_sampled_system_in_closed_form() -> None:
    """A rate held between samples: x(k + 1) = (1 - k T) x(k), exactly."""

    class Held(Model):
        stop_time = 1.0
        x: Scalar = variable("place", start=1, fixed=True)
        u: Scalar = discrete("speed")
        due: Scalar = discrete("time of the next sample")

        def equations(self):
            yield der(self.x) == self.u
            yield when(time >= self.due, reinit(self.u, -self.x / 2), reinit(self.due, self.due + 0.01), at_start=True)

    found = ac.simulate(Held(), intervals=100)
    np.testing.assert_allclose(found["x"], (1 - 0.01 / 2) ** np.arange(101), rtol=1e-12)


def test_what_has_no_value_at_an_instant_is_told() -> None:
    class NoConvergence(Plant):
        def sampling(self):
            wrong = ac.sqrt(0.355 - time)
            yield when(time >= self.due, reinit(self.u, wrong), reinit(self.due, self.due + self.period), at_start=True)

    with pytest.raises(ac.SimulationError, match=r"reinit\(\) gives no finite number") as caught:
        ac.simulate(NoConvergence())
    result: Any = caught.value.result
    assert result.time[-1] == pytest.approx(0.35, abs=0.02)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
@pytest.mark.parametrize("model", MODELS)
def test_energies_are_those_of_the_other_method(model: type[Model], tolerance: float) -> None:
    """Works between instants, and what jumps gain and lose; both balance with what is stored."""
    runs = both(model, tolerance=tolerance, intervals=70, energy=True)
    one, other = ([r.stats[f"energy_{name}"] for name in ("supplied", "dissipated", "stored_change")] for r in runs)
    size = np.sum(np.abs(other))
    damped = 10 if model is Beam else 1  # vibrations, that is, in all but the exact run
    np.testing.assert_allclose(one, other, rtol=0, atol=10 * damped * tolerance * size)
    assert abs(runs[0].stats.energy_method) < tolerance * size


def test_energies_of_a_controlled_pendulum() -> None:
    """What the motor supplies is what is stored, to rounding: nothing dissipates."""
    stats: Any = ac.simulate(compiled(SampledPendulum), stop_time=3.0, energy=True).stats
    assert stats.events == 3000
    assert stats.calls < 3100
    assert abs(stats.energy_method) < 1e-12 * stats.energy_supplied


class Beside(Model):
    """A sample is planned by sums of the period, and a law of time ends where rounding alone is between the two."""

    period: Scalar = parameter("period", unit="s", default=0.1)
    end: Scalar = parameter("end of the law", unit="s", default=0.9)
    x: Scalar = variable("state", fixed=True)
    due: Scalar = discrete("next sample", start=0)
    n: Scalar = discrete("samples", start=0)

    def equations(self):
        again = reinit(self.due, self.due + self.period), reinit(self.n, self.n + 1)
        yield when(time >= self.due, *again, at_start=True)
        yield der(self.x) == -self.x + piecewise((1, time < self.end), 0)


@pytest.mark.parametrize(("intervals", "method"), pairwise([1, 7, 400], ["auto", "rosenbrock", "idas"]))
def test_a_sample_is_on_a_break_where_rounding_alone_is_between_them(intervals: int, method: Any) -> None:
    compiled = ac.compile(Beside())
    for period, ends in ((0.1, (0.8, 0.9, 1.0, 1.1)), (0.05, (0.4, 0.55)), (0.01, (0.1,)), (0.02, (0.2,))):
        for end in ends:
            given = {"period": period, "end": end}
            run = ac.simulate(compiled, stop_time=2.05, intervals=intervals, method=method, parameters=given)
            assert run["x"][-1] == pytest.approx(np.exp(end - 2.05) - np.exp(-2.05), abs=5e-5)
            assert abs(run["n"][-1] - (np.floor(2.05 / period + 1e-6) + 1)) <= 1


class Counted(SliderCrank):
    """Slider-crank with a count of instants, of which rounding errors part some from outputs."""

    count: Scalar = discrete("instants up to now")
    due: Scalar = discrete("next instant", unit="s")

    def equations(self):
        yield from super().equations()
        yield when(
            time >= self.due, reinit(self.count, self.count + 1), reinit(self.due, self.due + 0.01), at_start=True
        )


@pytest.mark.filterwarnings("ignore:rod_bar")
@pytest.mark.parametrize("method", [None, "idas", "rosenbrock"])
def test_an_output_at_an_instant_shows_what_it_changes(method: str | None) -> None:
    result = ac.simulate(Counted(), intervals=20, method=method)
    np.testing.assert_array_equal(result["count"], np.floor(result.time / 0.01 + 1e-9) + 1)
