"""Times at which conditions are checked."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

GOLDEN = (5**0.5 - 1) / 2


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


def uneven(grid: np.ndarray, parts: int) -> np.ndarray:
    """Divide each interval into uneven parts, so that no periodic motion stays in step with the samples.

    Parameters
    ----------
    grid : array, shape (n + 1,)
        Ends of the intervals in s.
    parts : int
        Number of parts of each interval.
    """
    n = len(grid) - 1
    share = 0.6 + 0.8 * (np.arange(n * parts) * GOLDEN % 1).reshape(n, parts)
    inside = np.cumsum(share, axis=1) / np.sum(share, axis=1, keepdims=True) * np.diff(grid)[:, None]
    times = np.concatenate([grid[:1], (grid[:-1, None] + inside).ravel()])
    times[::parts] = grid
    return times


@lru_cache(maxsize=256)  # runs of one model have the same intervals
def spread(n: int, most: int) -> np.ndarray:
    """Return the indices of evenly spread rows of n, including the first and the last; the array is read-only."""
    found = np.unique(np.linspace(0, n - 1, min(n, most)).astype(int))
    found.setflags(write=False)
    return found
