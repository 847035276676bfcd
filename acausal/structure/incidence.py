"""Bipartite incidence of equations and variables in several representations."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np
import scipy

Rows = Sequence[Sequence[int]]


def sparse(rows: Rows, n_columns: int) -> scipy.sparse.csr_array:
    """Return the pattern of `rows` as a matrix of ones.

    Returns
    -------
    csr_array, shape (len(rows), n_columns)

    """
    pointer = np.zeros(len(rows) + 1, dtype=np.int32)
    np.cumsum([len(row) for row in rows], out=pointer[1:])
    indices = np.fromiter(chain.from_iterable(rows), dtype=np.int32, count=pointer[-1])
    return scipy.sparse.csr_array(
        (np.ones(len(indices), dtype=np.int8), indices, pointer), shape=(len(rows), n_columns)
    )


def transpose(rows: Rows, n_columns: int) -> list[list[int]]:
    """Return the rows that contain each of the `n_columns` columns, ascending."""
    columns: list[list[int]] = [[] for _ in range(n_columns)]
    for i, row in enumerate(rows):
        for j in row:
            columns[j].append(i)
    return columns


def chains(derivative: Sequence[int]) -> list[list[int]]:
    """Return each variable that is not a derivative, followed by its successive derivatives."""
    derived = set(derivative)
    result = []
    for variable in range(len(derivative)):
        if variable not in derived:
            chain_ = [variable]
            while derivative[chain_[-1]] >= 0:
                chain_.append(derivative[chain_[-1]])
            result.append(chain_)
    return result


def lowest(derivative: Sequence[int]) -> list[int]:
    """Return the lowest variable of the derivative chain of each variable."""
    root = list(range(len(derivative)))
    for chain_ in chains(derivative):
        for variable in chain_:
            root[variable] = chain_[0]
    return root
