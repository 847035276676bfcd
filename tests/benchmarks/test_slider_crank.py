"""The benchmark of the slider-crank in a cheap version: its numbers are small where they must be; no time is tested."""

from __future__ import annotations

import pytest

from tests.benchmarks import loop_closing, slider_crank, slider_crank_sizes


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
