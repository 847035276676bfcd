"""The motion between the ends of steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Curve:
    """Interpolants of steps in a row.

    Attributes
    ----------
    times : array, shape (m + 1,)
        Ends of the steps, ascending.
    y : array, shape (m + 1, n)
        Values there.
    dense : array, shape (m, rows, n)
        Coefficients of each step, as the library has them.
    """

    times: np.ndarray
    y: np.ndarray
    dense: np.ndarray

    def __call__(self, times: np.ndarray) -> np.ndarray:
        """Values at times in these steps, shape (k, n)."""
        k = np.clip(np.searchsorted(self.times, times) - 1, 0, len(self.dense) - 1)
        s = ((times - self.times[k]) / (self.times[k + 1] - self.times[k]))[:, None]
        *rest, d = np.moveaxis(self.dense[k], 1, 0)
        for row in reversed(rest):
            d = row + s * d
        return (1 - s) * self.y[k] + s * (self.y[k + 1] + (1 - s) * d)
