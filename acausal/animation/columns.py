"""Encode columns of numbers over time for a page, equal columns once."""

from __future__ import annotations

from base64 import b64encode
from typing import Any
from zlib import compress

import numpy as np

# Largest round-off of a column, relative to the size of the scene: a quarter of the promised 1e-6. Columns that float32
# would round by more, far from the origin, are stored as differences from an offset.
ROUND_OFF = 2.5e-7
FLOAT32 = 2.0**-24  # largest relative round-off of float32


class Column(int):
    """Preliminary number of a column: among the varying ones, or the complement of its number among the constants."""


class Columns:
    """Collector of columns.

    Parameters
    ----------
    frames : int
        Length of a column.
    """

    def __init__(self, frames: int) -> None:
        self.frames = frames
        self._varying: list[bytes] = []
        self._constants: list[bytes] = []
        self._known: dict[tuple[bytes, float], Column] = {}
        self._offsets: dict[Column, float] = {}

    def add(self, values: np.ndarray, size: float = 0.0) -> Any:
        """Add the columns of an array; return their preliminary numbers as nested lists of shape (...).

        Parameters
        ----------
        values : array, shape (frames, ...)
            Values over time.
        size : float
            Length relative to which round-off counts; 0 if float32 is sufficient.
        """
        exact = np.asarray(values, dtype=float)
        table = np.moveaxis(exact, 0, -1)
        rows = table.reshape(-1, self.frames)
        offsets = _offsets(rows, size)
        flat = np.ascontiguousarray(rows - offsets[:, None], dtype="<f4") + np.float32(0)  # no negative zeros
        constant = (flat == flat[:, :1]).all(axis=1)
        places = np.empty(len(flat), dtype=object)
        for k, row in enumerate(flat):
            key = row[:1].tobytes() if constant[k] else row.tobytes()
            places[k] = self._place(key, bool(constant[k]), float(offsets[k]))
        return places.reshape(table.shape[:-1]).tolist() if table.ndim > 1 else places[0]

    def _place(self, key: bytes, constant: bool, offset: float) -> Column:
        if self.frames == 1:
            constant = True
        if (key, offset) not in self._known:
            columns = self._constants if constant else self._varying
            place = self._known[key, offset] = Column(~len(columns) if constant else len(columns))
            columns.append(key)
            if offset:
                self._offsets[place] = offset
        return self._known[key, offset]

    def resolve(self, document: dict[str, Any]) -> dict[str, Any]:
        """Return a document with the data added and preliminary column numbers replaced by final ones."""
        data = b"".join([*self._varying, *self._constants])
        found = {
            "frames": self.frames,
            "varying": len(self._varying),
            "constant": len(self._constants),
            "data": encode(data),
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
    """Return the offset of each row, shape (rows,): the middle of its range if float32 is too coarse, otherwise 0."""
    with np.errstate(all="ignore"):
        low, high = np.fmin.reduce(rows, axis=1), np.fmax.reduce(rows, axis=1)
        largest = np.maximum(np.abs(low), np.abs(high))
        coarse = (FLOAT32 * largest > ROUND_OFF * size) & (high - low < largest) & (size > 0)
        return np.where(coarse & np.isfinite(low + high), low + (high - low) / 2, 0.0)


def encode(data: Any) -> str:
    """Return numbers as text: zlib, then base64."""
    return b64encode(
        compress(bytes(data) if isinstance(data, bytes) else np.ascontiguousarray(data).tobytes(), 6)
    ).decode()
