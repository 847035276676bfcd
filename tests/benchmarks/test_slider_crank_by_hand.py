"""The slider-crank derived by hand keeps its energy, and a method that does not follow the ringing keeps its motion."""

from __future__ import annotations

import numpy as np
import pytest

from tests.benchmarks.slider_crank_by_hand import build
from tests.benchmarks.slider_crank_methods import INTERVALS, STOP, SWITCH, Method, simulate

CUT = round(SWITCH / STOP * INTERVALS)


@pytest.mark.parametrize(
    "options",
    [{}, {"crank": "rigid"}, {"rod_volumes": 4}, {"slider_mass": 0.01}],
    ids=["elastic", "rigid", "volumes", "mass"],
)
def test_supplied_energy_is_stored(options):
    run = simulate(build(**options), Method("rosenbrock", 1e-6))
    assert run.stored[CUT] == pytest.approx(run.supplied[CUT], rel=1e-5)
    assert -1e-5 < run.dissipated < 1e-3


@pytest.mark.slow
def test_sizes_of_rates_leave_the_motion():
    model = build()
    exact = simulate(model, Method("rosenbrock", 1e-4, 10.0))
    run = simulate(model, Method("rosenbrock", 1e-5))
    error = np.abs(run.outputs - exact.outputs).max(axis=1) / np.ptp(exact.outputs, axis=1)
    assert error[1] < 1.6e-4
    assert error[3] < 1e-2
    assert run.steps < exact.steps / 10
