"""Sparse LU of the core."""

from __future__ import annotations

from ctypes import c_int64
from dataclasses import dataclass

import numpy as np

from acausal.core.library import loaded


@dataclass(frozen=True)
class Counts:
    """How often pivots were chosen and matrices factorised, entries of the factors, and operations of a factorisation."""

    chosen: int
    factored: int
    entries: int
    operations: int


class LU:
    """Factors of square matrices of one sparsity, whose pivots are kept while they are good.

    Parameters
    ----------
    start : array of int, shape (n + 1,)
        Where the entries of each column begin.
    row : array of int
        Row of each entry.
    """

    def __init__(self, start: np.ndarray, row: np.ndarray) -> None:
        self._library, self.n = loaded(), len(start) - 1
        start, row = np.ascontiguousarray(start, dtype=np.int32), np.ascontiguousarray(row, dtype=np.int32)
        self.entries = int(start[-1])
        self._memory = self._library.ac_lu_make(self.n, start.ctypes.data, row.ctypes.data)
        if not self._memory:
            raise MemoryError

    def __del__(self) -> None:
        if getattr(self, "_memory", None):
            self._library.ac_lu_free(self._memory)

    def factor(self, values: np.ndarray) -> bool:
        """Factorise; return whether the matrix is regular.

        Parameters
        ----------
        values : array
            Its entries, column by column.
        """
        values = np.ascontiguousarray(values, dtype=float)
        if values.shape != (self.entries,):
            raise ValueError(f"{self.entries} entries are expected, not {values.shape}")
        found = self._library.ac_lu_factor(self._memory, values.ctypes.data)
        if found < 0:
            raise MemoryError
        return found == 0

    def solve(self, b: np.ndarray) -> np.ndarray:
        """Return the solution of A x = b for the matrix that was factorised last."""
        x = np.array(b, dtype=float)
        if x.shape != (self.n,):
            raise ValueError(f"{self.n} values are expected, not {x.shape}")
        self._library.ac_lu_solve(self._memory, x.ctypes.data)
        return x

    @property
    def counts(self) -> Counts:
        """Counts so far."""
        counts = (c_int64 * 4)()
        self._library.ac_lu_counts(self._memory, counts)
        return Counts(*counts)
