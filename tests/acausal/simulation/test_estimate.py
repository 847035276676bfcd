"""Estimates of errors that are known."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from acausal.policy import POLICY
from acausal.simulation.estimate import estimate, scale

t = np.linspace(0, 2, 21)
EXACT = {"swing": 3 * np.sin(5 * t), "push": 1e3 * t, "rest": np.full_like(t, 7.0), "zero": 0 * t}
SHAPE = t * (2 - t)  # of the errors, at most 1


def run(**errors: float):
    """A result with such a part of the range, or of the size, of each output as its error."""
    outputs = [
        SimpleNamespace(name=name, values=values + errors.get(name, 0.0) * scale(values) * SHAPE)
        for name, values in EXACT.items()
    ]
    return SimpleNamespace(series=lambda: outputs)


def test_scale_is_the_range_or_the_size_or_1():
    found = scale(np.column_stack(list(EXACT.values())))
    np.testing.assert_allclose(found, [np.ptp(EXACT["swing"]), 2e3, 7, 1])
    assert scale(EXACT["rest"]) == 7
    assert scale(1e5 + 1e-9 * t) == pytest.approx(1e5)  # rounding is no motion


@pytest.mark.parametrize("tenths", [0.1, 0.01])
def test_an_error_that_falls_with_the_least_power_of_the_tolerance_is_found_exactly(tenths):
    fall = tenths**POLICY.estimate.by_tolerance
    found = estimate(run(swing=1e-4, push=-3e-4), run(swing=1e-4 * fall, push=-3e-4 * fall), tenths, None, None)
    expected = {"swing": 1e-4, "push": 3e-4, "rest": 0, "zero": 0}
    assert found.outputs == pytest.approx(expected, rel=1e-3, abs=1e-15)
    assert found.worst == "push"
    assert found.total == found.tolerance == found.outputs["push"]
    assert found.elements == 0


def test_an_error_that_falls_faster_is_found_as_well():
    assert estimate(run(swing=1e-4), run(), 0.1, None, None).total == pytest.approx(1e-4, rel=0.3)


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_the_order_in_the_number_of_elements_is_that_of_three_runs(order):
    def of(elements: float):
        return run(swing=1e-3 * elements**-order)

    found = estimate(of(1), of(1), 0.1, of(2), of(0.5))
    assert found.elements == found.total == pytest.approx(1e-3, rel=2e-3)
    assert found.tolerance == 0


def test_two_runs_take_order_two():
    def of(elements: float):
        return run(swing=1e-3 * elements**-2)

    assert estimate(of(1), of(1), 0.1, of(2), None).total == pytest.approx(1e-3, rel=1e-3)


@pytest.mark.parametrize(("order", "counted"), [(0.2, 1), (7, 4)])
def test_orders_that_cannot_be_are_not_believed(order, counted):
    def of(elements: float):
        return run(swing=1e-3 * elements**-order)

    difference = 1e-3 * (1 - 2.0**-order)
    found = estimate(of(1), of(1), 0.1, of(2), of(0.5))
    assert found.total == pytest.approx(difference / (1 - 2.0**-counted), rel=2e-3)


def test_both_errors_add_with_their_signs():
    finer, doubled = run(swing=0.0), run(swing=-3e-4)
    found = estimate(run(swing=1e-4), finer, 1e-9, doubled, None)
    assert (found.tolerance, found.elements, found.total) == pytest.approx((1e-4, 4e-4, 5e-4), rel=2e-3)
    against = estimate(run(swing=-1e-4), finer, 1e-9, doubled, None)
    assert against.total == pytest.approx(3e-4, rel=2e-3)


def test_what_is_no_number_is_infinitely_wrong():
    found = estimate(run(push=np.nan), run(), 0.1, None, None)
    assert (found.worst, found.total, found.tolerance) == ("push", np.inf, np.inf)
