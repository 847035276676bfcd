"""Events within the first second of runs of any length."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, parameter, piecewise, reinit, time, variable, when

G = 9.81


class Rests(Model):
    """A ball from 1 mm that rests as soon as it meets the floor at less than 0.01 m/s."""

    h: Scalar = variable("height", start=1e-3, fixed=True)
    v: Scalar = variable("speed", start=0, fixed=True)
    rests: Scalar = discrete("1 if it rests")
    n: Scalar = discrete("impacts")

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == piecewise((0.0, self.rests > 0.5), -G)
        slow = self.v > -0.01
        stays = (reinit(self.v, piecewise((0.0, slow), -0.9 * self.v)), reinit(self.rests, piecewise((1.0, slow), 0.0)))
        yield when((self.h < 0) & (self.v < 0), *stays, reinit(self.n, self.n + 1))


@pytest.mark.filterwarnings("ignore:.*faster than they are checked:acausal.AcausalWarning")
# IDAS loses impacts in runs of 30 years: its first steps take days.
@pytest.mark.parametrize("stop", [1.0, 1e5, 1e9])
def test_impacts_are_as_exact_however_long_the_run_is(stop):
    result = ac.simulate(Rests(), stop_time=stop, tolerance=1e-8)
    n = 1 + int(np.ceil(np.log(0.01 / np.sqrt(2 * G * 1e-3)) / np.log(0.9)))
    assert result["n"][-1] == n
    falls = np.sqrt(2e-3 / G) * (1 + 2 * np.cumsum([0.0, *0.9 ** np.arange(1, n)]))
    assert np.max(np.min(np.abs(falls[:, None] - np.array(result.stats["event_times"])), axis=1)) < 1e-9


class Planned(Model):
    """Counts instants that discrete variables plan."""

    period: Scalar = parameter("between them", unit="s", default=1.0)
    n: Scalar = discrete("how many")
    due: Scalar = discrete("the next one", unit="s", start=0.5 * period)
    x: Scalar = variable("grows", fixed=True)

    def equations(self):
        yield der(self.x) * self.period == 1
        yield when(time >= self.due, reinit(self.n, self.n + 1), reinit(self.due, self.due + self.period))


@pytest.mark.parametrize("method", ["auto", "idas"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-8])
def test_planned_instants_act_however_short_the_run_is(tolerance, method):
    compiled = ac.compile(Planned())
    for period in (1e-12, 1e-9, 1e-6, 1.0, 1e6):
        for periods in (1, 20):
            how = {"stop_time": periods * period, "tolerance": tolerance, "method": method}
            assert ac.simulate(compiled, parameters={"period": period}, **how)["n"][-1] == periods
