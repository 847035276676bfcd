"""Find where a function of time leaves its side of zero, from values and derivatives at given times.

Between two times the function is the cubic that has its values and derivatives there (Hermite). Its error is estimated
by the cubics over two intervals at a time, sixteen times less accurate, at the point between.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.solve.hermite import coefficients, cubic


@dataclass(frozen=True)
class Sides:
    """Functions that are positive as long as nothing happens: times (n,), values and derivatives (n, m)."""

    times: np.ndarray
    value: np.ndarray
    rate: np.ndarray


def levels(sides: Sides, slack: np.ndarray) -> np.ndarray:
    """Least value of each function at each time that counts as its side.

    That is 0 once it was positive; what starts at or below 0, as after an impact, may be lower by `slack`.
    """
    risen = np.maximum.accumulate(sides.value, axis=0) > 0
    return np.where(risen, 0.0, np.minimum(sides.value[0], 0.0) - slack)


def dips(sides: Sides) -> tuple[np.ndarray, np.ndarray]:
    """Return the least values of the cubics inside each interval, and estimates of their errors; (n - 1, m)."""
    h = np.diff(sides.times)[:, None]
    a, b = sides.value[:-1], sides.value[1:]
    da, db = sides.rate[:-1] * h, sides.rate[1:] * h
    c3, c2 = coefficients(a, b, da, db)
    least = np.minimum(a, b)
    root = np.sqrt(np.maximum(c2**2 - 3 * c3 * da, 0.0))
    for sign in (1.0, -1.0):
        # Both forms of the root of the derivative, so that none cancels.
        for top, bottom in ((-c2 + sign * root, 3 * c3), (da, -c2 - sign * root)):
            s = np.divide(top, bottom, out=np.zeros_like(top), where=np.abs(bottom) > np.finfo(float).tiny)
            s = np.fmin(np.fmax(s, 0.0), 1.0)
            least = np.minimum(least, ((c3 * s + c2) * s + da) * s + a)
    return least, _errors(sides)


def _errors(sides: Sides) -> np.ndarray:
    n = len(sides.times)
    error = np.full((n - 1, sides.value.shape[1]), np.inf)
    if n < 3:
        return error
    t, g, d = sides.times[:, None], sides.value, sides.rate
    h = t[2:] - t[:-2]
    middle, _ = cubic((t[1:-1] - t[:-2]) / h, h, (g[:-2], g[2:]), (d[:-2], d[2:]))
    inner = np.abs(middle - g[1:-1])
    error[0], error[-1] = inner[0], inner[-1]
    error[1:-1] = np.maximum(inner[:-1], inner[1:])
    return error / 4


def turns(sides: Sides, level: np.ndarray) -> list[int]:
    """Return intervals in which a condition turns away from its change, where its tangents at both ends meet beyond it.

    A convex function lies above its tangents: elsewhere it cannot change and change back.
    """
    value, rate = sides.value - level, sides.rate
    h, turning = np.diff(sides.times)[:, None], (rate[:-1] < 0) & (rate[1:] > 0)
    bend = np.where(turning, rate[1:] - rate[:-1], 1.0)
    tangents = (value[:-1] * rate[1:] - value[1:] * rate[:-1] + rate[:-1] * rate[1:] * h) / bend
    return np.flatnonzero(np.any(turning & (tangents < 0), axis=1)).tolist()


def root(times: tuple[float, float], value: tuple[float, float], rate: tuple[float, float]) -> float:
    """Return where the cubic through two points is 0; its values there are positive and not positive."""
    h = times[1] - times[0]
    (a, b), (da, db) = value, (rate[0] * h, rate[1] * h)
    c3, c2 = coefficients(a, b, da, db)

    def value_at(s: float) -> float:
        return ((c3 * s + c2) * s + da) * s + a

    if b >= 0 or not value_at(1.0) < 0:  # where rates are so large that they hide b
        return times[1]
    # Newton's iteration, halving the interval where that leads out of it or on too slowly.
    low, high, s, step = 0.0, 1.0, 0.5, 1.0
    while abs(step) > np.finfo(float).eps:
        here, slope = value_at(s), (3 * c3 * s + 2 * c2) * s + da
        if here == 0:
            break
        low, high = (s, high) if here > 0 else (low, s)
        if abs(2 * here) < abs(step * slope) and low < s - here / slope < high:
            step = -here / slope
            s += step
        else:
            step = (high - low) / 2
            s = low + step
    return times[0] + h * s
