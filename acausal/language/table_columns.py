"""Columns of a table, as the core looks them up: each with its length first."""

from __future__ import annotations

import numpy as np

from acausal.language import interpolation

# Widening of a table without extrapolation, in parts of its range: times at its end have rounding errors.
WIDENED = 1e-12
NEVER = 1e300  # end of the last piece: finite, as a condition compares it


def search(x: np.ndarray, kind: str, extrapolation: str) -> list[np.ndarray]:
    """Return where to search, origins of the polynomials, then start, period and number of rows.

    The last point belongs to the segment before, so that slopes there are those of the table.
    """
    found, margin = x.copy(), WIDENED * np.ptp(x)
    if extrapolation == "refuse":
        found[0], found[-1] = x[0] - margin, np.nextafter(x[-1] + margin, np.inf)
    elif extrapolation == "periodic":
        found[0], found[-1] = -np.inf, np.inf
    elif kind != "constant" and len(x) > 1 and x[-1] > x[-2]:
        found[-1] = np.nextafter(x[-1], np.inf)
    return [found, np.concatenate([x[:1], x]), np.array([x[0], np.ptp(x), len(x) + 1])]


def curve(x: np.ndarray, y: np.ndarray, kind: str, extrapolation: str, ends: str) -> np.ndarray:
    """Return the coefficients of values y (n, k), shape (n + 1, 4 k): before the first point, between points, behind the last."""
    inner = np.zeros((len(x) - 1, y.shape[1], 4))
    inner[..., 0] = y[:-1]  # all of those of no length, at jumps
    cuts = (np.flatnonzero(np.diff(x) == 0) + 1).tolist()
    for a, b in zip([0, *cuts], [*cuts, len(x)], strict=True):
        if b > a + 1:
            inner[a : b - 1] = interpolation.segments(kind, x[a:b], y[a:b], ends)
    found = _ended(inner, x, y[-1], extrapolation).reshape(len(x) + 1, -1)
    if kind == "constant" and extrapolation == "linear":
        found[[0, -1]] = curve(x, y, "linear", extrapolation, ends)[[0, -1]]
    return found


def surface(x: np.ndarray, y: np.ndarray, z: np.ndarray, kind: str, extrapolation: str) -> np.ndarray:
    """Return the coefficients of values z (n, m), shape ((n + 1)(m + 1), 16)."""
    steps = kind == "constant"
    c = np.swapaxes(interpolation.surface(kind, x, y, z), 2, 3)  # (n - 1, m - 1, in y, in x)
    c = _ended(c, x, _constants(z[-1, :-1]) if steps else _at_end(c, x), extrapolation)
    c = np.moveaxis(np.swapaxes(c, 2, 3), 1, 0)  # (m - 1, n + 1, in x, in y)
    c = _ended(c, y, _constants(z[[0, *range(len(x))], -1]) if steps else _at_end(c, y), extrapolation)
    return np.moveaxis(c, 0, 1).reshape(-1, 16)


def pieces(x: np.ndarray, jumps: np.ndarray, periodic: bool) -> list[np.ndarray]:
    """Return where pieces between jumps end, and their first and last rows."""
    jumps, first, last, end = np.unique(jumps), 0, len(x), NEVER
    if periodic:  # from one end to the other, where the values next to the inner points hold
        jumps, end = jumps[(jumps > x[0]) & (jumps < x[-1])], x[-1]
        first, last = np.searchsorted(x, x[0], side="right"), np.searchsorted(x, x[-1], side="left")
    before, after = (np.searchsorted(x, jumps, side=side) for side in ("left", "right"))
    return [np.append(jumps, end), np.append(first, after), np.append(before, last)]


def _ended(c: np.ndarray, x: np.ndarray, last: np.ndarray, extrapolation: str) -> np.ndarray:
    if not len(c):  # one point
        return np.repeat(np.pad(last[..., None], [*[(0, 0)] * last.ndim, (0, 3)])[None], 2, axis=0)
    return interpolation.with_ends(c, last, x[-1] - x[-2], extrapolation)


def _at_end(c: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Return the values of polynomials by the first axis at the last point."""
    return c[-1] @ (x[-1] - x[-2]) ** np.arange(4)


def _constants(values: np.ndarray) -> np.ndarray:
    """Return the coefficients of constants, shape (n, 4)."""
    return np.pad(values[:, None], ((0, 0), (0, 3)))
