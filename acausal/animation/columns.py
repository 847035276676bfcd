"""Columns of numbers over time, equal ones once, as the text that a page reads."""

from __future__ import annotations

from base64 import b64encode
from typing import Any
from zlib import compress

import numpy as np


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
        self._known: dict[bytes, Column] = {}

    def add(self, values: np.ndarray) -> Any:
        """Add what varies, shape (frames, ...); return the places of its columns, as nested lists of shape (...)."""
        table = np.ascontiguousarray(np.moveaxis(values, 0, -1), dtype="<f4") + np.float32(0)  # no negative zeros
        flat = table.reshape(-1, self.frames)
        still = (flat == flat[:, :1]).all(axis=1)
        places = np.empty(len(flat), dtype=object)
        for k, row in enumerate(flat):
            places[k] = self._place(row[:1].tobytes() if still[k] else row.tobytes(), bool(still[k]))
        return places.reshape(table.shape[:-1]).tolist() if table.ndim > 1 else places[0]

    def _place(self, key: bytes, constant: bool) -> Column:
        if self.frames == 1:
            constant = True
        if key not in self._known:
            kept = self._constants if constant else self._varying
            self._known[key] = Column(~len(kept) if constant else len(kept))
            kept.append(key)
        return self._known[key]

    def closed(self, document: dict[str, Any]) -> dict[str, Any]:
        """Return a document with the data, and with the numbers of the columns in place of their places."""
        data = b"".join([*self._varying, *self._constants])
        found = {
            "frames": self.frames,
            "varying": len(self._varying),
            "constant": len(self._constants),
            "data": blob(data),
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


def blob(data: Any) -> str:
    """Return numbers as text: compressed by deflate with the header of zlib, in base64."""
    return b64encode(
        compress(bytes(data) if isinstance(data, bytes) else np.ascontiguousarray(data).tobytes(), 6)
    ).decode()
