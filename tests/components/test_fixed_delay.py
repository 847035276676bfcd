"""FixedDelay: closed forms by the method of steps, jumps, relays, several runs, and what it cannot do."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, connect, der, piecewise, quantity, variable
from components.blocks import FixedDelay, Sine, Step
from components.translational import Mass, Position

METHODS = ("rosenbrock", "idas")


def sine(scale):
    class Delayed(Model):
        sine, delay = Sine(f=1 / scale), FixedDelay(delay_time=0.3 * scale)

        def connections(self):
            yield connect(self.sine.y, self.delay.u)

    return Delayed()


@pytest.mark.parametrize("scale", [1e-6, 1, 1e5])
def test_a_sine_to_the_tolerance(scale):
    for tolerance in (1e-5, 1e-7, 1e-9):
        result = ac.simulate(sine(scale), stop_time=3 * scale, tolerance=tolerance)
        t = result.time / scale
        right = np.where(t < 0.3, 0, np.sin(2 * np.pi * (t - 0.3)))
        assert np.abs(result["delay.y"] - right).max() < 10 * tolerance


class Lagging(Model):
    """x' = -x(t - T), x = 1 until the start."""

    delay = FixedDelay(delay_time=1)
    x: Scalar = variable("state", start=1, fixed=True)

    def equations(self):
        yield quantity(1, "s") * der(self.x) == -self.delay.y
        yield self.delay.u == self.x


def by_steps(t):
    a, b = t - 1, t - 2
    return np.select([t <= 1, t <= 2], [1 - t, a**2 / 2 - a], -0.5 + b**2 / 2 - b**3 / 6)


@pytest.mark.parametrize("method", METHODS)
def test_a_loop_with_a_state(method):
    model = ac.compile(Lagging())
    first, other = (
        ac.simulate(model, stop_time=3, tolerance=1e-8, method=method, parameters={"delay.delay_time": T})
        for T in (1, 0.5)
    )
    np.testing.assert_allclose(first["x"], by_steps(first.time), atol=1e-6)
    # Values of a run are read after another one.
    np.testing.assert_allclose(first["delay.y"], np.where(first.time < 1, 1, by_steps(first.time - 1)), atol=1e-6)
    # With T = 1/2 in place of 1 it is not the same function of t / T: x' = -x(t - T), and x falls by T in a delay.
    t = other.time[other.time <= 1]
    np.testing.assert_allclose(
        other["x"][: len(t)], np.where(t <= 0.5, 1 - t, 0.5 - (t - 0.5) + (t - 0.5) ** 2 / 2), atol=1e-6
    )


class Echo(Model):
    """A loop of a gain and a delay."""

    step, delay = Step(start_time=0.5), FixedDelay(delay_time=0.3)

    def equations(self):
        yield self.delay.u == self.step.y - 0.5 * self.delay.y


@pytest.mark.parametrize("method", METHODS)
def test_jumps_come_back_after_each_delay(method):
    model = ac.compile(Echo())
    assert "signal loop" not in model.summary()
    result = ac.simulate(model, stop_time=2.05, method=method)
    np.testing.assert_allclose(result.stats["event_times"], [0.8, 1.1, 1.4, 1.7, 2.0], atol=1e-12)
    echoes = np.floor((result.time - 0.5 + 1e-9) / 0.3) + 1
    np.testing.assert_allclose(result["delay.u"], np.where(echoes > 0, (1 - (-0.5) ** echoes) / 1.5, 0), atol=1e-12)


def test_runs_of_threads_do_not_mix():
    model = ac.compile(sine(1))

    def run(T):
        result = ac.simulate(model, stop_time=20, intervals=50, tolerance=1e-8, parameters={"delay.delay_time": T})
        return np.abs(result["delay.y"] - np.where(result.time < T, 0, np.sin(2 * np.pi * (result.time - T)))).max()

    with ThreadPoolExecutor(4) as threads:
        assert max(threads.map(run, np.linspace(0.2, 0.6, 12))) < 1e-6


class Relay(Model):
    """A relay that sees its state late: a limit cycle whose extremes are beyond the threshold by the delay."""

    delay = FixedDelay(delay_time=0.7)
    x: Scalar = variable("state", start=0, fixed=True)

    def equations(self):
        yield quantity(1, "s") * der(self.x) == piecewise((1, self.delay.y < 0.2), -1)
        yield self.delay.u == self.x


@pytest.mark.parametrize("method", METHODS)
def test_a_relay(method):
    result = ac.simulate(Relay(), stop_time=6, tolerance=1e-8, method=method)
    np.testing.assert_allclose(result.stats["event_times"], [0.9, 2.3, 3.7, 5.1], atol=1e-7)
    np.testing.assert_allclose([result["x"].max(), result["x"].min()], [0.9, -0.5], atol=1e-2)


def test_what_it_cannot_do(tmp_path):
    class Driven(Model):
        sine, delay, drive, mass = Sine(), FixedDelay(), Position(), Mass(m=1)

        def connections(self):
            yield connect(self.sine.y, self.delay.u)
            yield connect(self.delay.y, self.drive.s_ref)
            yield connect(self.drive.flange, self.mass.flange_a)

    with pytest.raises(ac.DeclarationError, match=r"delay \(FixedDelay\).* the derivative of the delayed signal"):
        ac.compile(Driven())
    with pytest.raises(ac.ExportError, match="`delay`"):
        ac.export_fmu(Lagging(), tmp_path / "lagging.fmu")
    with pytest.warns(ac.AcausalWarning, match="`delay` are not called"):
        ac.linearize(Lagging())
    with pytest.raises(ac.DeclarationError, match="delay_time"):
        ac.simulate(Lagging(), stop_time=1, parameters={"delay.delay_time": 0})
