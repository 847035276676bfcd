"""Quantised variables over time."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.animation.series import STEPS, Series
from tests.acausal.animation.explorer import series
from tests.acausal.animation.places import unpacked

TIME = np.linspace(0, 1, 301)
NOISE = np.random.default_rng(3).normal(size=301)
GAP = np.where(TIME < 0.3, np.nan, TIME)
VARYING = {
    "smooth": np.sin(9 * TIME),
    "noise": NOISE,
    "small": 1e-300 * NOISE,
    "large": 1e307 * np.sign(NOISE),
    "far": 1e9 + TIME,
    "step": np.where(TIME < 0.5, -2.0, 3.0),
    "gap": GAP,
    "infinite": np.where(TIME < 0.3, np.inf, TIME),
    "one value": np.where(TIME < 0.3, np.nan, 4.0),
}


@pytest.mark.parametrize("places", [np.arange(301), np.arange(0, 301, 7), np.array([5])])
def test_values_are_exact_to_half_a_step(places: np.ndarray) -> None:
    collected = Series(301)
    numbers = {name: collected.add(values) for name, values in VARYING.items()}
    document = collected.document(places)
    found = series(document, len(places))
    assert document["varying"] == len(found) == len(VARYING) - 1  # gap and infinite are equal
    for name, values in VARYING.items():
        exact = np.where(np.isfinite(values), values, np.nan)[places]
        seen = exact[np.isfinite(exact)]
        step = np.ptp(seen) / STEPS if seen.size else 0
        error = 0.51 * step + 1e-15 * np.abs(seen).max(initial=0)
        np.testing.assert_allclose(found[numbers[name]], exact, rtol=0, atol=error, err_msg=name)


def test_equal_ones_and_constants_are_stored_once() -> None:
    collected = Series(301)
    values = (TIME, TIME.copy(), 0 * TIME, -0.0 * TIME, np.full(301, 7.0), np.full(301, np.nan), np.full(301, np.inf))
    assert [collected.add(one) for one in values] == [0, 0, ~0, ~0, ~1, ~2, ~2]
    assert unpacked(collected.document(np.arange(301))["constants"], "<f8") == pytest.approx(
        [0, 7, np.nan], nan_ok=True
    )
