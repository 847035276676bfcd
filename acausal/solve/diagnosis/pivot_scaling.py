"""Scaling of equations and unknowns that no choice of units changes."""

from __future__ import annotations

import numpy as np
import scipy

from acausal.policy import POLICY

GRID = POLICY.loops.grid


def scaled_to_pivots(J: scipy.sparse.csc_matrix) -> scipy.sparse.csc_matrix | None:
    """Scale rows and columns so that the transversal of largest product has entries of 1, and no entry is larger.

    The transversal comes to the diagonal. None if there is none: the matrix is structurally singular. Its logarithms are a
    matching of least weight, and the factors its dual variables (Duff and Koster 2001), found as shortest paths.

    Parameters
    ----------
    J : csc_matrix, shape (n, n)
        Its entries are finite.
    """
    entries, n = J.tocoo(), J.shape[0]
    on = entries.data != 0
    row, column, data = entries.row[on], entries.col[on], entries.data[on]
    # On a grid their sums are exact: the search may turn for ever where they round.
    length = -np.round(np.log(np.abs(data)) / GRID) * GRID
    weights = scipy.sparse.csr_matrix((length - np.min(length, initial=0.0) + 1.0, (row, column)), shape=J.shape)
    try:
        rows, columns = scipy.sparse.csgraph.min_weight_full_bipartite_matching(weights)
    except ValueError:
        return None
    of_row = np.empty(n, dtype=int)
    of_row[rows] = columns
    own = np.empty(n)
    matched = of_row[row] == column
    own[row[matched]] = length[matched]
    source = np.full(n, n), np.arange(n)
    ends = np.concatenate([of_row[row[~matched]], source[0]]), np.concatenate([column[~matched], source[1]])
    edges = np.concatenate([(length - own[row])[~matched] + GRID, np.ones(n)])
    graph = scipy.sparse.csr_matrix((edges, ends), shape=(n + 1, n + 1))
    potential = scipy.sparse.csgraph.bellman_ford(graph, indices=n)[:n]
    entry = data * np.exp(own[row] - potential[of_row[row]] + potential[column])
    return scipy.sparse.csc_matrix((entry, (of_row[row], column)), shape=J.shape)
