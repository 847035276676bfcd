"""The order limit by trial: never much more work than the better of both, and stated."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, output, variable
from models import FreeVibration, SpinUp
from tests.shared import compiled

RATES = (1.0, 90.0)


class Modes(Model):
    """A slow oscillation, and a fast one of a millionth of its size that its sum with the slow one holds."""

    slow: Scalar = variable("slow coordinate", start=1.0, fixed=True)
    fast: Scalar = variable("fast coordinate", start=1e-6, fixed=True)
    v: Scalar = variable("der(slow)", start=0.0, fixed=True)
    w: Scalar = variable("der(fast)", start=0.0, fixed=True)
    sum: Scalar = output("sum of both")

    def equations(self):
        yield from (self.v == der(self.slow), self.w == der(self.fast))
        yield from (der(self.v) == -(RATES[0] ** 2) * self.slow, der(self.w) == -(RATES[1] ** 2) * self.fast)
        yield self.sum == self.slow + self.fast


class Watched(Modes):
    """The same with a condition that is watched and never holds."""

    past: Scalar = output("1 where the sum is beyond all that it reaches")

    def equations(self):
        yield from super().equations()
        yield self.past == ac.piecewise((1, self.sum > 2), 0)


def work(stats: ac.Statistics) -> int:
    return stats["residual_evaluations"]


@pytest.mark.parametrize("tolerance", [1e-6, pytest.param(1e-8, marks=pytest.mark.slow)])
def test_modes_are_followed_by_the_better_order(tolerance):
    model, options = compiled(Modes), {"stop_time": 40.0, "tolerance": tolerance, "method": "idas", "intervals": 800}
    results = {order: ac.simulate(model, max_order=order, **options) for order in (None, 2, 5)}
    stats = {order: result.stats for order, result in results.items()}
    assert work(stats[None]) <= 2 * work(stats[5]) <= 0.5 * work(stats[2])
    assert stats[2]["order_reason"] == "given"
    times = results[None].time
    assert np.allclose(times, np.linspace(0, 40, 801), rtol=0, atol=1e-9)
    error = np.max(np.abs(results[None]["slow"] - np.cos(times)))
    assert error <= 1e4 * tolerance


@pytest.mark.parametrize("intervals", [1, 2, 3, 7])
def test_few_outputs(intervals):
    found = ac.simulate(compiled(Modes), stop_time=20.0, tolerance=1e-8, method="idas", intervals=intervals)
    assert len(found.time) == intervals + 1
    assert np.max(np.abs(found["slow"] - np.cos(found.time))) <= 1e-4


def test_the_reason_is_told():
    stats = ac.simulate(compiled(Modes), stop_time=40.0, tolerance=1e-8, method="idas").stats
    assert stats["max_order"] == 5
    assert "90 1/s" in stats["order_reason"]
    assert "a trial took" in stats["order_reason"]
    stats = ac.simulate(compiled(SpinUp), stop_time=2.0).stats
    assert stats["max_order"] == 2
    assert "trial" not in stats["order_reason"]


@pytest.mark.slow
def test_watched_conditions_change_nothing():
    found = ac.simulate(compiled(Watched), stop_time=50.0, tolerance=1e-8, method="idas")
    assert np.max(np.abs(found["slow"] - np.cos(found.time))) <= 1e-4
    assert not found["past"].any()


@pytest.mark.parametrize(
    ("tolerance", "best"),
    [(1e-4, 2), (1e-6, 5), *(pytest.param(*case, marks=pytest.mark.slow) for case in ((3e-5, 2), (3e-7, 5)))],
)
def test_free_vibration(tolerance, best):
    options = {"stop_time": 0.5, "tolerance": tolerance, "intervals": 250}
    stats = ac.simulate(compiled(FreeVibration), **options).stats
    other = ac.simulate(compiled(FreeVibration), max_order=best, **options).stats
    assert stats["max_order"] == best
    assert stats["steps"] <= 1.2 * other["steps"]
    assert work(stats) <= 1.2 * work(other)


def test_works_go_on_through_trials():
    options = {"stop_time": 0.2, "tolerance": 1e-6, "intervals": 100, "energy": True}
    found, given = (ac.simulate(compiled(FreeVibration), max_order=order, **options).stats for order in (None, 5))
    assert "a trial took" in found["order_reason"]
    for name in ("energy_supplied", "energy_stored_change", "energy_dissipated"):
        assert found[name] == pytest.approx(given[name], abs=1e-5), name
