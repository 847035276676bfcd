"""Scaling of equations and unknowns that is independent of units."""

from __future__ import annotations

import numpy as np
import scipy

from acausal.policy import POLICY

GRID = POLICY.loops.grid


def scaled_to_pivots(J: scipy.sparse.csc_matrix) -> scipy.sparse.csc_matrix | None:
    """Scale and permute so that the transversal of largest product is a diagonal of ones and no other entry exceeds 1.

    The logarithms of its entries are a matching of least weight, those of the scale factors the dual variables (Duff and
    Koster 2001), found as shortest paths. None if the matrix is structurally singular.

    Parameters
    ----------
    J : csc_matrix, shape (n, n)
        With finite entries.
    """
    entries, n = J.tocoo(), J.shape[0]
    on = entries.data != 0
    row, column, data = entries.row[on], entries.col[on], entries.data[on]
    # Sums of multiples of GRID are exact; with round-off the matching may cycle for ever.
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
