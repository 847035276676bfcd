"""Events just behind a break time, where what was at rest changes faster than the steps before it."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, exp, parameter, piecewise, time, variable
from tests.shared import compiled

BREAK = 0.5


class Sticking(Model):
    """A mass on a spring creeps in Stribeck friction; its load falls at the break time, and it breaks away."""

    x: Scalar = variable("position", unit="m", start=0, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)

    def equations(self):
        speed = piecewise((self.v, self.v > 0), -self.v)
        far = 20 + 2 * exp(-(speed - 1e-3) / 1e-3)
        friction = piecewise((far, self.v > 1e-3), (-far, self.v < -1e-3), 22e3 * self.v)
        yield der(self.x) == self.v
        yield der(self.v) == piecewise((40, time >= BREAK), 200) - 1600 * self.x - friction


class Lag(Model):
    """A lag follows a step at the break time; what it passes on begins where it reaches a level."""

    tau: Scalar = parameter("time constant", unit="s", default=1e-4)
    level: Scalar = parameter("level that switches", default=0.1)
    x: Scalar = variable("integral of the lag", unit="s", start=0, fixed=True)
    u: Scalar = variable("lag", start=0, fixed=True)
    on: Scalar = variable("time since the level", unit="s", start=0, fixed=True)

    def equations(self):
        yield der(self.x) == self.u
        yield self.tau * der(self.u) == piecewise((0, time < BREAK), 1) - self.u
        yield der(self.on) == piecewise((1, self.u > self.level), 0)


def late(result: ac.Result) -> float:
    """Return how long after the break time the first event is."""
    return next((t for t in result.stats.event_times if t > BREAK), np.inf) - BREAK


@pytest.mark.parametrize("tolerance", [1e-4, 1e-5, 1e-6])
def test_a_mass_breaks_away(tolerance: float) -> None:
    """As Radau of scipy and IDAS at 1e-11 have it: the speed passes 1 mm/s after 6.72 microseconds."""
    result = ac.simulate(compiled(Sticking), stop_time=0.55, tolerance=tolerance)
    assert late(result) == pytest.approx(6.7236e-6, abs=2e-6)
    assert result["x"][-1] == pytest.approx(1.086143e-3, abs=max(tolerance, 1e-5))


@pytest.mark.parametrize("level", [0.1, 0.6])
def test_a_lag_reaches_its_level(level: float) -> None:
    """It does so -tau log(1 - level) behind the break time."""
    tau, tolerance = 1e-4, 1e-4
    result = ac.simulate(compiled(Lag), stop_time=1.0, tolerance=tolerance, parameters={"tau": tau, "level": level})
    passed = -tau * np.log(1 - level)
    assert late(result) == pytest.approx(passed, abs=0.1 * tau)
    assert result["on"][-1] == pytest.approx(1 - BREAK - passed, abs=0.1 * tau)
