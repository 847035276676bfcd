"""Slopes and coefficients of piecewise cubic interpolants."""

from __future__ import annotations

import numpy as np

KINDS = ("constant", "linear", "akima", "modified_akima", "fritsch_butland", "steffen", "cubic")
ENDS = ("natural", "clamped", "periodic")


def slopes(kind: str, x: np.ndarray, y: np.ndarray, ends: str = "natural") -> np.ndarray:
    """Return the slopes of an interpolant at its points, shape (n, m).

    Parameters
    ----------
    kind : str
        One of `KINDS` from "akima" on.
    x : array, shape (n,)
        Abscissae, ascending.
    y : array, shape (n, m)
        Values, each column of its own.
    ends : str
        Ends of a "cubic": no curvature, no slope, or slope and curvature alike.
    """
    h, m = np.diff(x)[:, None], np.diff(y, axis=0) / np.diff(x)[:, None]
    if len(x) == 2 and not (kind == "cubic" and ends == "clamped"):
        return np.repeat(m, 2, axis=0)
    if kind == "cubic":
        from scipy.interpolate import CubicSpline

        return CubicSpline(x, y, bc_type=ends)(x, 1)
    if kind in ("akima", "modified_akima"):
        return akima(m, modified=kind == "modified_akima")
    left, right, one_way = m[:-1], m[1:], m[:-1] * m[1:] > 0
    with np.errstate(all="ignore"):
        inner = (fritsch_butland if kind == "fritsch_butland" else steffen)(h[:-1], h[1:], left, right)
    return np.concatenate([m[:1], np.where(one_way, inner, 0), m[-1:]])


def akima(m: np.ndarray, modified: bool = False) -> np.ndarray:
    """Return Akima's slopes from those of the segments (Akima 1970; modified as in MATLAB's makima).

    Parameters
    ----------
    m : array, shape (n - 1, ...)
        Slopes of the segments.
    modified : bool
        Whether the weights have the mean slopes as well, so that values which are equal give a slope of 0.
    """
    m = extended(m)
    before, after = _weights(m, modified)
    return before * m[1:-2] + after * m[2:-1]


def extended(m: np.ndarray) -> np.ndarray:
    """Return slopes of segments with two more at each end, extrapolated linearly (Akima 1970); one alone is repeated."""
    second, last = (m[1], m[-2]) if len(m) > 1 else (m[0], m[0])
    before, after = [3 * m[0] - 2 * second, 2 * m[0] - second], [2 * m[-1] - last, 3 * m[-1] - 2 * last]
    return np.concatenate([before, m, after])


def fritsch_butland(h0: np.ndarray, h1: np.ndarray, m0: np.ndarray, m1: np.ndarray) -> np.ndarray:
    """Return slopes between segments of lengths h0, h1 and slopes m0, m1 of one sign (Fritsch, Butland 1984)."""
    return 3 * (h0 + h1) / ((h0 + 2 * h1) / m0 + (h1 + 2 * h0) / m1)


def steffen(h0: np.ndarray, h1: np.ndarray, m0: np.ndarray, m1: np.ndarray) -> np.ndarray:
    """Return slopes between segments of lengths h0, h1 and slopes m0, m1 of one sign (Steffen 1990)."""
    mean = (m0 * h1 + m1 * h0) / (h0 + h1)
    return np.sign(mean) * np.minimum(np.abs(mean), 2 * np.minimum(np.abs(m0), np.abs(m1)))


def hermite(x: np.ndarray, y: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Return coefficients of cubics by values and slopes at their ends, shape (n - 1, m, 4), the constant first."""
    h, m = np.diff(x)[:, None], np.diff(y, axis=0) / np.diff(x)[:, None]
    return np.stack([y[:-1], d[:-1], (3 * m - 2 * d[:-1] - d[1:]) / h, (d[:-1] + d[1:] - 2 * m) / h**2], axis=-1)


def segments(kind: str, x: np.ndarray, y: np.ndarray, ends: str = "natural") -> np.ndarray:
    """Return the coefficients of an interpolant between its points, shape (n - 1, m, 4), the constant first."""
    if kind in ("constant", "linear"):
        found = np.zeros((len(x) - 1, y.shape[1], 4))
        found[..., 0] = y[:-1]
        if kind == "linear":
            found[..., 1] = np.diff(y, axis=0) / np.diff(x)[:, None]
        return found
    return hermite(x, y, slopes(kind, x, y, ends))


def surface(kind: str, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the coefficients of an interpolant in the cells of a grid, shape (n - 1, m - 1, 4, 4), by powers in x and in y.

    Parameters
    ----------
    kind : str
        "constant", "linear" (bilinear) or "akima" (Akima 1974).
    x, y : arrays, shapes (n,), (m,)
        Abscissae, ascending.
    z : array, shape (n, m)
        Values.
    """
    if kind != "akima":
        in_x = segments(kind, x, z)  # (n - 1, m, 4)
        in_y = segments(kind, y, np.moveaxis(in_x, 1, 0).reshape(len(y), -1))
        return np.moveaxis(in_y.reshape(len(y) - 1, len(x) - 1, 4, 4), 0, 1)
    zx, zy, zxy = partial_slopes(x, y, z)
    values, along = (np.moveaxis(hermite(x, *pair), 1, 0).reshape(len(y), -1) for pair in ((z, zx), (zy, zxy)))
    return np.moveaxis(hermite(y, values, along).reshape(len(y) - 1, len(x) - 1, 4, 4), 0, 1)


def partial_slopes(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the derivatives of z by x, by y and by both on a grid (Akima 1974)."""
    (x, z), (y, zt) = _extended(x, z), (y, z)
    y, zt = _extended(y, z.T)
    z = zt.T
    in_x, in_y = np.diff(z, axis=0) / np.diff(x)[:, None], np.diff(z, axis=1) / np.diff(y)
    mixed = np.diff(in_y, axis=0) / np.diff(x)[:, None]
    wx, wy = _weights(in_x[:, 2:-2]), _weights(in_y[2:-2].T).transpose(0, 2, 1)
    zx = wx[0] * in_x[1:-2, 2:-2] + wx[1] * in_x[2:-1, 2:-2]
    zy = wy[0] * in_y[2:-2, 1:-2] + wy[1] * in_y[2:-2, 2:-1]
    cells = [[mixed[1 + i : len(mixed) - 2 + i, 1 + j : mixed.shape[1] - 2 + j] for j in (0, 1)] for i in (0, 1)]
    mixed = [wx[i] * wy[j] * cells[i][j] for i in (0, 1) for j in (0, 1)]
    return zx, zy, np.sum(mixed, axis=0)


def _extended(x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return abscissae and values with two more at each end of the first axis."""
    h, m = np.diff(x), extended(np.diff(z, axis=0) / np.diff(x)[:, None])
    h = np.concatenate([h[:1], h[1:2] if len(h) > 1 else h, h, h[-2:-1] if len(h) > 1 else h, h[-1:]])
    x0 = x[0] - h[0] - h[1]
    steps = np.concatenate([np.zeros((1, z.shape[1])), np.cumsum(m * h[:, None], axis=0)])
    return x0 + np.concatenate([[0.0], np.cumsum(h)]), z[0] + steps - steps[2]


def _weights(m: np.ndarray, modified: bool = False) -> np.ndarray:
    """Return the weights of the slopes before and after each point, shape (2, n, ...)."""
    size = np.abs(np.diff(m, axis=0)) + (np.abs(m[1:] + m[:-1]) / 2 if modified else 0)
    after, before = size[2:], size[:-2]
    total = after + before
    part = np.divide(before, total, out=np.full_like(total, 0.5), where=total > 0)
    return np.stack([1 - part, part])


def with_ends(c: np.ndarray, last: np.ndarray, h: float, extrapolation: str) -> np.ndarray:
    """Return coefficients by the first axis, powers on the last, with those before the first point and after the last one.

    Parameters
    ----------
    c : array, shape (n - 1, ..., 4)
        Coefficients between the points.
    last : array
        Value at the last point.
    h : float
        Length of the last segment.
    extrapolation : str
        "hold", "linear", or another one for none.
    """
    before, after = np.zeros_like(c[:1]), np.zeros_like(c[-1:])
    before[0, ..., 0], after[0, ..., 0] = c[0, ..., 0], last
    if extrapolation == "linear":
        before[0, ..., 1], after[0, ..., 1] = c[0, ..., 1], c[-1] @ np.array([0, 1, 2 * h, 3 * h**2])
    elif extrapolation != "hold":
        before[:], after[:] = np.nan, np.nan
    return np.concatenate([before, c, after])
