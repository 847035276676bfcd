"""Select the times of a run that become frames of its animation."""

from __future__ import annotations

import numpy as np

FRAMES = 2000


def select_frames(time: np.ndarray, frames: int = FRAMES) -> np.ndarray:
    """Return indices of evenly spaced times, with the first, the last and both sides of every jump.

    Parameters
    ----------
    time : array, shape (times,)
        Not decreasing; equal times are the two sides of a jump.
    frames : int
        Number of frames, at least 2. Only the sides of jumps add to it.
    """
    if len(time) <= frames:
        return np.arange(len(time))
    before = np.flatnonzero(np.diff(time) == 0)
    even = np.round(np.linspace(0, len(time) - 1, frames)).astype(int)
    return np.unique(np.concatenate([even, before, before + 1]))
