"""The benchmark of the slider-crank in a cheap version: its numbers are small where they must be; no time is tested."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
import models
from tests.benchmarks import loop_closing, slider_crank, slider_crank_sizes
from tests.benchmarks.slider_crank_by_hand import build
from tests.benchmarks.slider_crank_methods import INTERVALS, STOP, Method, simulate


@pytest.fixture(scope="module")
def own() -> slider_crank.Curves:
    return slider_crank.by_hand()


@pytest.mark.slow
def test_compiled_agrees_with_the_hand(own):
    (cost,) = slider_crank.compiled_costs({}, [1e-5], own, own, repeats=1)
    assert cost.own[0] < 2e-4
    assert cost.own[1] < 1e-2
    assert abs(cost.dissipated) < 2e-3
    assert slider_crank.accuracy_table([cost]).row_count == 1


@pytest.mark.slow
def test_what_follows_vibrations_converges_to_the_motion_derived_by_hand():
    result = ac.simulate(models.SliderCrank(), stop_time=STOP, intervals=INTERVALS, tolerance=1e-9)
    assert not result.stats["damped"]
    ours = np.array([result[name] for name in result.outputs])
    hand = (simulate(build(), Method("rosenbrock", tolerance, velocities=1.0)).outputs for tolerance in (1e-5, 1e-6))
    errors = [np.max(np.abs(other - ours).max(axis=1) / np.ptp(ours, axis=1)) for other in hand]
    assert errors[1] < 1e-4
    assert errors[1] < errors[0] / 5


def test_sizes():
    found = slider_crank_sizes.sizes(["rigid"], [2], repeats=1)
    assert found[0].difference < 1e-4
    assert found[0].ours.states >= found[0].mark.states
    assert slider_crank_sizes.table(found).row_count == 1


def test_ways_to_close_a_loop():
    found = loop_closing.rows(loop_closing.SCENES[:1], repeats=1)
    assert [row.way for row in found] == list(loop_closing.WAYS)
    assert all(row.error < 1e-3 and row.gap < 1e-12 for row in found)
    assert loop_closing.table(found).row_count == 2
