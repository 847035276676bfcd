"""Laws that become stiff at an event: a first step that does not resolve them would take what moves to rest."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, parameter, piecewise, reinit, time, variable, when
from acausal.solve.integrate import settings

G = 9.81
METHODS = ["auto", "rosenbrock", "idas"]
# At 1e12 1/s2, errors of 1e-6 m, which methods that know nothing of the step before an event may make in one, are 1e6 m/s2.
CASES = [(k, method) for k in (1e4, 1e8, 1e12) for method in METHODS if k < 1e12 or method != "idas"]


class Trampoline(Model):
    """A ball dropped from 1 m on a spring without mass or damping."""

    k: Scalar = parameter("stiffness over mass", unit="1/s2", default=1e8)
    x: Scalar = variable("height", unit="m", start=1.0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0.0, fixed=True)

    def equations(self):
        yield der(self.x) == self.v
        yield der(self.v) == -G + piecewise((-self.k * self.x, self.x < 0), 0.0)


def bounces(k: float, stop: float) -> np.ndarray:
    """Times at which the ball meets or leaves the spring."""
    v = np.sqrt(2 * G)
    omega, rest = np.sqrt(k), G / k
    # Below 0, x = -rest (1 - cos(omega t)) - v / omega sin(omega t).
    contact = 2 * (np.pi - np.arctan2(v / omega, rest)) / omega
    flight = 2 * v / G
    times = [flight / 2]
    while times[-1] < stop:
        times += [times[-1] + contact, times[-1] + contact + flight]
    return np.array([t for t in times if t < stop])


@pytest.mark.parametrize(("k", "method"), CASES)
@pytest.mark.parametrize("intervals", [3, 400])
def test_a_ball_bounces_however_stiff_what_it_meets(k: float, intervals: int, method: Any) -> None:
    result = ac.simulate(
        Trampoline(), stop_time=2.0, tolerance=1e-6, intervals=intervals, method=method, parameters={"k": k}
    )
    exact = bounces(k, 2.0)
    assert len(exact) == 4
    np.testing.assert_allclose(result.stats["event_times"], exact, atol=2e-4 if method == "idas" else 2e-5)
    assert result.stats["calls"] <= 1 + len(exact)
    assert result.stats["steps"] <= (60 if method == "idas" else 30) * len(exact)


class Kicked(Model):
    """A mass at 1 m/s that a spring turns back, from one instant on and for half a period of its vibration."""

    omega: Scalar = parameter("frequency", unit="rad/s", default=1e4)
    x: Scalar = variable("place", unit="m", start=0.0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=1.0, fixed=True)

    def equations(self):
        until = 1.0 + np.pi / self.omega
        yield der(self.x) == self.v
        yield der(self.v) == piecewise((0.0, time < 1.0), (-(self.omega**2) * (self.x - 1), time < until), 0.0)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("intervals", [2, 400])
def test_a_law_that_the_clock_makes_stiff(intervals: int, method: Any) -> None:
    result = ac.simulate(Kicked(), stop_time=2.0, tolerance=1e-6, intervals=intervals, method=method)
    assert result["v"][-1] == pytest.approx(-1, abs=1e-4)
    assert result["x"][-1] == pytest.approx(np.pi / 1e4, abs=1e-4)


class Ringing(Model):
    """A vibration that has died out long before the first output: exp(-10 t) cos(1000 t), nearly."""

    x: Scalar = variable("x", start=1, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)
    n: Scalar = discrete("n")

    def equations(self):
        yield self.v == der(self.x)
        yield der(self.v) == -1e6 * self.x - 20 * self.v
        yield when(self.x > 0.3, reinit(self.n, self.n + 1))


def test_where_an_interval_takes_more_steps_than_allowed_conditions_are_checked_more_often(monkeypatch):
    """With as few steps allowed as are taken in a second: the peaks are below 0.3 after 19 of them."""
    monkeypatch.setattr(settings, "RESCUE", replace(settings.RESCUE, long=2_000, fewest_long=2_000))
    result = ac.simulate(Ringing(), stop_time=1e4, intervals=100, method="idas")
    assert result["n"][-1] == 19
