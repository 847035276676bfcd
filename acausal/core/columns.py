"""Columns of numbers of this process, which equations look up by their numbers."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from ctypes import addressof, byref
from functools import cached_property

import numpy as np

from acausal.core.library import TablesData, address, loaded


class Columns:
    """Columns by their numbers; a number is never used again.

    Cleared numbers stay in arrays of parameters, and caches compare these.
    """

    def __init__(self) -> None:
        self._places = [np.zeros(64, dtype=np.uintp)]  # addresses; the arrays before stay for evaluations under way
        self._data = TablesData(0, address(self._places[-1]))

    @cached_property
    def address(self) -> int:
        """Address of all columns, as tapes hold it."""
        loaded(runs=False).ac_share_tables(byref(self._data))
        return addressof(self._data)

    def add(self, owner: object, columns: Sequence[np.ndarray]) -> int:
        """Add columns that last as long as their owner; return the number of the first.

        Parameters
        ----------
        owner : object
            Holds the arrays.
        columns : sequence of arrays
            Each begins with how many numbers follow.
        """
        first, end = self._data.count, self._data.count + len(columns)
        if end > len(self._places[-1]):
            self._places.append(np.concatenate([self._places[-1], np.zeros(end, dtype=np.uintp)]))
        self._places[-1][first:end] = [address(column) or 0 for column in columns]
        self._data.column, self._data.count = address(self._places[-1]), end
        weakref.finalize(owner, self._clear, first, end)
        return first

    def _clear(self, first: int, end: int) -> None:
        self._places[-1][first:end] = 0


COLUMNS = Columns()
