"""The cubic that has given values and slopes at two points (Hermite)."""

from __future__ import annotations

from typing import TypeVar

import numpy as np

Number = TypeVar("Number", float, np.ndarray)


def coefficients(a: Number, b: Number, da: Number, db: Number) -> tuple[Number, Number]:
    """Return c3, c2 of c3 s^3 + c2 s^2 + da s + a, which is b with the slope db at s = 1."""
    return 2 * a - 2 * b + da + db, 3 * (b - a) - 2 * da - db


def cubic(
    s: np.ndarray,
    h: np.ndarray | float,
    value: tuple[np.ndarray, np.ndarray] | np.ndarray,
    rate: tuple[np.ndarray, np.ndarray] | np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Value and slope at parts s of an interval of length h, from values and rates at its two ends."""
    (a, b), da, db = value, rate[0] * h, rate[1] * h
    c3, c2 = coefficients(a, b, da, db)
    return ((c3 * s + c2) * s + da) * s + a, ((3 * c3 * s + 2 * c2) * s + da) / h
