"""Times at which conditions are looked at."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.solve.looks import pace, uneven

GRID = np.array([0.0, 1.0, 2.0, 2.5, 4.0])


@pytest.mark.parametrize("parts", [1, 2, 8, 32])
def test_each_interval_has_so_many_parts_and_no_part_is_long(parts):
    times = uneven(GRID, parts)
    assert len(times) == 4 * parts + 1
    np.testing.assert_array_equal(times[::parts], GRID)
    step = np.diff(times).reshape(-1, parts) * parts / np.diff(GRID)[:, None]
    assert np.all(step > 0.6 / 1.4)
    assert np.all(step < 1.4 / 0.6)


@pytest.mark.parametrize("turns", range(1, 33))
def test_no_motion_comes_round_from_one_look_to_the_next_all_the_time(turns):
    """At even looks a motion of as many turns as there are parts seems to rest."""
    times = uneven(np.linspace(0, 10, 11), 8)
    assert np.ptp(np.sin(2 * np.pi * turns * times)) > 1.0
    assert np.ptp(np.cos(2 * np.pi * turns * times)) > 0.4


def test_pace_is_the_way_at_the_greater_rate_of_both_ends():
    times = np.array([0.0, 1.0, 3.0])
    np.testing.assert_allclose(pace(times, np.array([1.0, -4.0, 2.0])), [4, 8])
    rate = np.array([[1.0, 0.0], [-4.0, 0.5], [2.0, -1.0]])
    np.testing.assert_allclose(pace(times, rate), [[4, 0.5], [8, 2]])
