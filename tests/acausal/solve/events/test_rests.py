"""Short laws of time after a rest are not passed over."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, exp, parameter, piecewise, structural, tanh, time, variable, when
from acausal.solve.events.rests import _ends

LOOKS = np.linspace(0, 1, 401)


class Struck(Model):
    """A mass of 1 kg on a spring of 1 N/m, struck by a smooth pulse of 1 N."""

    at: float = parameter("time of the pulse", unit="s", default=7.0)
    width: float = parameter("its width", unit="s", default=0.05)
    after: float = structural("before that there is none", default=0.0)
    watched: bool = structural("whether something might happen", default=False)
    x: Scalar = variable("x", start=0, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)
    count: Scalar = ac.discrete("passages", start=0)

    def equations(self):
        law = exp(-(((time - self.at) / self.width) ** 2))
        yield der(self.x) == self.v
        yield der(self.v) == (piecewise((law, time > self.after), 0) if self.after else law) - self.x
        if self.watched:
            yield when(self.x > 1e3, ac.reinit(self.count, self.count + 1))


@pytest.mark.parametrize("model", [{}, {"watched": True}, {"after": 2.5}, {"after": 2.5, "watched": True}])
@pytest.mark.parametrize("method", ["auto", "rosenbrock"])
@pytest.mark.parametrize(("tolerance", "intervals"), [(1e-3, 20), (1e-3, 400), (1e-6, 3), (1e-6, 20), (1e-6, 4000)])
def test_a_pulse_that_ends_a_rest(model, method, tolerance, intervals) -> None:
    """x = w sqrt(pi) exp(-w^2 / 4) sin(t - at) after it."""
    compiled = ac.compile(Struck(**model))
    for at, width in ((7.0, 0.05), (3.0, 0.1), (12.34, 0.2), (19.0, 0.06)):
        given = {"at": at, "width": width}
        found = ac.simulate(
            compiled, stop_time=20.0, parameters=given, tolerance=tolerance, intervals=intervals, method=method
        )
        size = width * np.sqrt(np.pi) * np.exp(-(width**2) / 4)
        end = size * np.sin(20.0 - at)
        # Absolute errors count in sizes of 1 m unless states turn out smaller.
        assert found["x"][-1] == pytest.approx(end, abs=100 * tolerance * size + 1e-9)
        assert len(found.time) == intervals + 1


def test_what_acts_and_returns() -> None:
    pulse = np.exp(-(((LOOKS - 0.6) / 0.01) ** 2))
    other = -2 * np.exp(-(((LOOKS - 0.3) / 0.005) ** 2))
    ends = _ends(pulse[:, None])
    assert len(ends) == 1
    assert 0.5 < LOOKS[ends[0]] < 0.57
    assert len(_ends((pulse + other)[:, None])) == 2
    assert _ends(np.column_stack([pulse, LOOKS, other, pulse])) == [*_ends(other[:, None]), *ends]


@pytest.mark.parametrize(
    "law",
    [
        np.zeros(401),
        LOOKS,
        np.sin(100 * LOOKS),
        LOOKS**3 - np.sin(LOOKS) ** 3,
        np.tanh((LOOKS - 0.5) / 1e-4),
        np.where(LOOKS < 0.5, 0.0, 1.0),
        np.exp(-(((LOOKS - 0.6) / 0.2) ** 2)),
        np.full(401, np.nan),
    ],
)
def test_what_stays_or_never_rests(law) -> None:
    assert _ends(law[:, None]) == []


def test_steps_that_stay_cost_no_call() -> None:
    class Pushed(Model):
        x: Scalar = variable("x", start=0, fixed=True)

        def equations(self):
            yield der(self.x) == tanh((time - 5) / 0.01) + 1 - self.x

    found = ac.simulate(Pushed(), stop_time=10.0, tolerance=1e-6)
    assert found.stats.calls == 1
    assert found["x"][-1] == pytest.approx(2 * (1 - np.exp(-5)), abs=1e-4)


class Kicked(Model):
    """A mass of 1 kg on a spring of 1 N/m, kicked by 1 N.s in a short time that a law without a jump names."""

    at: Scalar = parameter("when", unit="s", default=0)
    width: Scalar = parameter("for how long", unit="s", default=0.01)
    x: Scalar = variable("x", start=0, fixed=True)
    v: Scalar = variable("v", start=0, fixed=True)

    def equations(self):
        since = time - self.at
        law = (1 - ac.cos(2 * np.pi * since / self.width)) / self.width
        yield der(self.x) == self.v
        yield der(self.v) == piecewise((law, (since > 0) & (since < self.width)), 0, smooth=True) - self.x


@pytest.mark.parametrize("method", ["auto", "rosenbrock", "idas"])
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_a_short_case_of_a_smooth_law(method, tolerance) -> None:
    """x = sin(t - at - width / 2) after it, but for width^2."""
    for at in (0.0, 7.0):
        compiled = ac.compile(Kicked(at=at))
        for width in (0.1, 1e-2, 1e-4, 1e-6):
            given = {"width": width}
            found = ac.simulate(compiled, stop_time=20.0, parameters=given, tolerance=tolerance, method=method)
            expected = np.sin(20.0 - at - width / 2)
            assert found["x"][-1] == pytest.approx(expected, abs=100 * tolerance + width**2)
            assert not found.stats.event_times
