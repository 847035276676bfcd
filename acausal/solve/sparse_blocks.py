"""Blocks of sparse matrices: submatrices, and the connected blocks into which a pattern decouples."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from acausal.compiler.linearization import with_entries

Places = np.ndarray | list[int]


@dataclass(frozen=True, eq=False)
class Block:
    """Submatrix of all matrices of one pattern.

    Attributes
    ----------
    rows, columns : arrays of int
        Rows and columns of the whole matrix.
    entries : array of int
        Entries of the whole matrix that are in the block, column by column.
    places : array of int, shape (2, n)
        Row and column of each entry, in the block.
    """

    rows: np.ndarray
    columns: np.ndarray
    entries: np.ndarray
    places: np.ndarray

    @classmethod
    def placed(cls, rows: np.ndarray, columns: np.ndarray, entries: np.ndarray, places: np.ndarray) -> Block:
        """Return a block from its entries in any order."""
        order = np.lexsort(places)
        return cls(rows, columns, entries[order], places[:, order].astype(np.int32, order="C"))

    @cached_property
    def _pattern(self) -> scipy.sparse.csc_matrix:
        starts = np.searchsorted(self.places[1], np.arange(len(self.columns) + 1)).astype(np.int32)
        shape = len(self.rows), len(self.columns)
        return scipy.sparse.csc_matrix((np.zeros(len(self.entries)), self.places[0], starts), shape=shape)

    def dense(self, values: np.ndarray) -> np.ndarray:
        """Return the block, shape (..., m, n), from the entries of the whole, shape (..., k)."""
        full = np.zeros((*values.shape[:-1], len(self.rows), len(self.columns)))
        full[..., self.places[0], self.places[1]] = values[..., self.entries]
        return full

    def sparse(self, values: np.ndarray) -> scipy.sparse.csc_matrix:
        """Return the block from the entries of the whole, shape (k,)."""
        return with_entries(self._pattern, values[self.entries])


def block_of(J: scipy.sparse.csc_matrix, rows: Places, columns: Places) -> Block:
    """Return the block of some rows and columns of a matrix, in this order."""
    row, column = (np.full(n, -1, dtype=np.int32) for n in J.shape)
    row[rows], column[columns] = np.arange(len(rows)), np.arange(len(columns))
    places = np.array([row[J.indices], np.repeat(column, np.diff(J.indptr))])
    entries = np.flatnonzero(np.all(places >= 0, axis=0))
    return Block.placed(np.asarray(rows), np.asarray(columns), entries, places[:, entries])


def connected_blocks(rows: np.ndarray, columns: np.ndarray, shape: tuple[int, int]) -> list[Block]:
    """Return the connected blocks of a matrix, from the places of its entries; an empty row is a block of its own."""
    m, n = shape
    graph = scipy.sparse.coo_matrix((np.ones(len(rows)), (rows, m + columns)), shape=(m + n, m + n))
    count, label = scipy.sparse.csgraph.connected_components(graph, directed=False)
    own_rows, own_columns, own_entries = (_grouped(k, count) for k in (label[:m], label[m:], label[rows]))
    local = np.zeros((2, max(shape)), dtype=int)
    found = []
    for of_rows, of_columns, entries in zip(own_rows, own_columns, own_entries, strict=True):
        if of_rows.size:
            local[0, of_rows], local[1, of_columns] = np.arange(len(of_rows)), np.arange(len(of_columns))
            places = np.array([local[0, rows[entries]], local[1, columns[entries]]])
            found.append(Block.placed(of_rows, of_columns, entries, places))
    return found


def connected_blocks_of(J: scipy.sparse.csc_matrix) -> list[Block]:
    """Return the connected blocks of a matrix, to be evaluated with the entries in its order."""
    return connected_blocks(J.indices, np.repeat(np.arange(J.shape[1]), np.diff(J.indptr)), J.shape)


def _grouped(label: np.ndarray, count: int) -> list[np.ndarray]:
    """Places of each label, ascending."""
    return np.split(np.argsort(label, kind="stable"), np.cumsum(np.bincount(label, minlength=count))[:-1])
