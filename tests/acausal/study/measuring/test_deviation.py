"""Deviations as fractions of the range of the reference."""

import numpy as np
import pytest

from acausal.study import deviations

T = np.linspace(0, 1, 5)


def test_relative_to_the_range():
    found = deviations({"x": 3 + 2 * T, "y": T}, {"x": 3 + 4 * T})
    assert found == {"x": (pytest.approx(0.5), pytest.approx(0.5 * np.sqrt(np.mean(T**2))))}


@pytest.mark.parametrize(
    ("reference", "expected"),
    [(np.full(5, -4.0), 0.25), (np.zeros(5), 1.0), (1e-17 * np.cos(40 * T), 1.0), (1e-9 * T, 1e9)],
    ids=["rests", "zero", "rounding", "small"],
)
def test_outputs_that_rest(reference, expected):
    assert deviations({"x": reference + 1.0}, {"x": reference})["x"][0] == pytest.approx(expected)


def test_ranges_of_others():
    found = deviations({"x": np.zeros(5)}, {"x": np.full(5, 1e-3)}, {"x": 2 * T})
    assert found["x"][0] == pytest.approx(5e-4)
