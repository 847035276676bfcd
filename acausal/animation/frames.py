"""Which times of a run are frames of its picture."""

from __future__ import annotations

import numpy as np

FRAMES = 2000


def thinned(time: np.ndarray, frames: int = FRAMES) -> np.ndarray:
    """Return the places of about so many times, evenly spread; the first, the last and both sides of jumps are among them.

    Parameters
    ----------
    time : array, shape (times,)
        Not decreasing; equal times are the two sides of a jump.
    frames : int
        At least 2. There are more only for the sides of jumps.
    """
    if len(time) <= frames:
        return np.arange(len(time))
    before = np.flatnonzero(np.diff(time) == 0)
    even = np.round(np.linspace(0, len(time) - 1, frames)).astype(int)
    return np.unique(np.concatenate([even, before, before + 1]))
