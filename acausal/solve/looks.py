"""Times at which conditions are checked."""

from __future__ import annotations

from functools import lru_cache

import numpy as np


def pace(times: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """Return the change of functions in each interval at the larger of their rates at its ends.

    Parameters
    ----------
    times : array, shape (n,)
        Times in s.
    rate : array, shape (n,) or (n, m)
        Rates at the times.
    """
    fastest = np.maximum(np.abs(rate[1:]), np.abs(rate[:-1]))
    return (fastest.T * np.diff(times)).T


@lru_cache(maxsize=256)  # runs of one model have the same intervals
def spread(n: int, most: int) -> np.ndarray:
    """Return the indices of evenly spread rows of n, including the first and the last; the array is read-only."""
    found = np.unique(np.linspace(0, n - 1, min(n, most)).astype(int))
    found.setflags(write=False)
    return found
