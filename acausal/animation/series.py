"""Encode many variables over time for the explorer: quantised, equal ones once, constants as one number."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.animation.columns import encode

# Steps in the range of a variable: four to five digits, as far as the readings of a plot go. The code above them is NaN.
STEPS = 2**16 - 2
MISSING = STEPS + 1


class Series:
    """Collector of variables over time.

    Parameters
    ----------
    times : int
        Length of a variable.
    """

    def __init__(self, times: int) -> None:
        self.times = times
        self._varying: dict[bytes, int] = {}
        self._constants: dict[bytes, int] = {}

    def add(self, values: np.ndarray) -> int:
        """Add a variable and return its number: k of the k-th varying one, ~k of the k-th constant.

        Parameters
        ----------
        values : array, shape (times,)
            Values over time.
        """
        exact = np.where(np.isfinite(values), values, np.nan) + 0.0  # one zero, one NaN
        constant = bool((exact == exact[0]).all() or np.isnan(exact).all())
        known, key = (self._constants, exact[:1]) if constant else (self._varying, exact)
        place = known.setdefault(key.tobytes(), len(known))
        return ~place if constant else place

    @property
    def varying(self) -> int:
        """Number of variables that change."""
        return len(self._varying)

    def document(self, places: np.ndarray) -> dict[str, Any]:
        """Return the variables at some of the times, as `explorer.series` in page/DOCUMENT.md.

        Parameters
        ----------
        places : array of int
            Indices of the times.
        """
        rows = [np.frombuffer(row)[places] for row in self._varying]
        table = np.array(rows).reshape(len(rows), len(places))
        low, step, codes = quantised(table)
        return {
            "varying": len(rows),
            "low": encode(low),
            "step": encode(step),
            "codes": encode(differences(codes)),
            "constants": encode(np.frombuffer(b"".join(self._constants))),
        }


def quantised(table: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the smallest value and the step of each row, shape (rows,), and codes: values are low + step * code.

    Parameters
    ----------
    table : array, shape (rows, times)
        Values; NaN becomes the code MISSING.
    """
    low, high = (pick(table, axis=1, initial=bound) for pick, bound in ((np.nanmin, np.inf), (np.nanmax, -np.inf)))
    low, high = np.where(np.isfinite(low), low, 0.0), np.where(np.isfinite(high), high, 0.0)
    step = (high - low) / STEPS
    steps = np.round((table - low[:, None]) / np.where(step > 0, step, 1.0)[:, None])
    codes = np.where(np.isnan(table), MISSING, np.clip(steps, 0, STEPS)).astype("<u2")
    return low, step, codes


def differences(codes: np.ndarray) -> bytes:
    """Return third differences of the codes along each row, modulo 2**16: near 0 small and positive, low bytes first.

    The high bytes of smooth curves are 0 and compress well.
    """
    thrice = codes
    for _ in range(3):
        thrice = np.diff(thrice, axis=1, prepend=codes.dtype.type(0))
    signed = thrice.astype("<i2")
    small = ((signed << 1) ^ (signed >> 15)).astype("<u2")
    return small.view(np.uint8).reshape(-1, 2).T.tobytes()
