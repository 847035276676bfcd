"""Changes of functions between times."""

from __future__ import annotations

import numpy as np

from acausal.solve.looks import pace


def test_pace_is_the_way_at_the_greater_rate_of_both_ends():
    times = np.array([0.0, 1.0, 3.0])
    np.testing.assert_allclose(pace(times, np.array([1.0, -4.0, 2.0])), [4, 8])
    rate = np.array([[1.0, 0.0], [-4.0, 0.5], [2.0, -1.0]])
    np.testing.assert_allclose(pace(times, rate), [[4, 0.5], [8, 2]])
