"""Columns of numbers over time, equal ones once, as the text that a page reads."""

from __future__ import annotations

from base64 import b64encode
from typing import Any
from zlib import compress

import numpy as np

# Of the length that counts: where float32 rounds by more, far from the origin, a column is kept as differences.
EXACT = 2.5e-7
HALF_BIT = 2.0**-24  # of a number: the largest error of float32


class Column(int):
    """Place of a column before all are known: that of a varying one, or the complement of that of a constant."""


class Columns:
    """Collects columns.

    Parameters
    ----------
    frames : int
        Length of each.
    """

    def __init__(self, frames: int) -> None:
        self.frames = frames
        self._varying: list[bytes] = []
        self._constants: list[bytes] = []
        self._known: dict[tuple[bytes, float], Column] = {}
        self._offsets: dict[Column, float] = {}

    def add(self, values: np.ndarray, size: float = 0.0) -> Any:
        """Add what varies; return the places of its columns, as nested lists of shape (...).

        Parameters
        ----------
        values : array, shape (frames, ...)
            What varies.
        size : float
            Differences that are small beside it do not count; 0 where float32 is good enough.
        """
        exact = np.asarray(values, dtype=float)
        table = np.moveaxis(exact, 0, -1)
        rows = table.reshape(-1, self.frames)
        offsets = _offsets(rows, size)
        flat = np.ascontiguousarray(rows - offsets[:, None], dtype="<f4") + np.float32(0)  # no negative zeros
        still = (flat == flat[:, :1]).all(axis=1)
        places = np.empty(len(flat), dtype=object)
        for k, row in enumerate(flat):
            key = row[:1].tobytes() if still[k] else row.tobytes()
            places[k] = self._place(key, bool(still[k]), float(offsets[k]))
        return places.reshape(table.shape[:-1]).tolist() if table.ndim > 1 else places[0]

    def _place(self, key: bytes, constant: bool, offset: float) -> Column:
        if self.frames == 1:
            constant = True
        if (key, offset) not in self._known:
            kept = self._constants if constant else self._varying
            place = self._known[key, offset] = Column(~len(kept) if constant else len(kept))
            kept.append(key)
            if offset:
                self._offsets[place] = offset
        return self._known[key, offset]

    def closed(self, document: dict[str, Any]) -> dict[str, Any]:
        """Return a document with the data, and with the numbers of the columns in place of their places."""
        data = b"".join([*self._varying, *self._constants])
        found = {
            "frames": self.frames,
            "varying": len(self._varying),
            "constant": len(self._constants),
            "data": blob(data),
            "offsets": {str(self._numbered(place)): offset for place, offset in self._offsets.items()},
        }
        return found | self._numbered(document)

    def _numbered(self, value: Any) -> Any:
        if isinstance(value, Column):
            return int(value) if value >= 0 else len(self._varying) + ~int(value)
        if isinstance(value, dict):
            return {key: self._numbered(inner) for key, inner in value.items()}
        if isinstance(value, list):
            return [self._numbered(inner) for inner in value]
        return value


def _offsets(rows: np.ndarray, size: float) -> np.ndarray:
    """Return what is subtracted of each row, shape (rows,): the middle of its range, where float32 would be too coarse."""
    with np.errstate(all="ignore"):
        low, high = np.fmin.reduce(rows, axis=1), np.fmax.reduce(rows, axis=1)
        largest = np.maximum(np.abs(low), np.abs(high))
        coarse = (HALF_BIT * largest > EXACT * size) & (high - low < largest) & (size > 0)
        return np.where(coarse & np.isfinite(low + high), low + (high - low) / 2, 0.0)


def blob(data: Any) -> str:
    """Return numbers as text: compressed by deflate with the header of zlib, in base64."""
    return b64encode(
        compress(bytes(data) if isinstance(data, bytes) else np.ascontiguousarray(data).tobytes(), 6)
    ).decode()
