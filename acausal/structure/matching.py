"""Maximum bipartite matching, at once and by one more vertex."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import maximum_bipartite_matching

from acausal.structure.incidence import Rows, sparse


@dataclass(frozen=True)
class Matching:
    """Pairs of equations and variables; -1 where there is no partner.

    Parameters
    ----------
    variable_of : list of int, shape (n_equations,)
    equation_of : list of int, shape (n_variables,)

    """

    variable_of: list[int]
    equation_of: list[int]


@dataclass(frozen=True)
class Search:
    """Outcome of one search: whether it found a path, and the vertices of both sides that it visited."""

    found: bool
    left: list[int]
    right: list[int]


def maximum_matching(rows: Rows, n_variables: int) -> Matching:
    """Match as many equations as possible (Hopcroft & Karp 1973, of scipy).

    Short equations come first: in the given order the search of scipy can take exponentially long.
    """
    order = np.argsort([len(row) for row in rows], kind="stable")
    found = maximum_bipartite_matching(sparse([rows[k] for k in order], n_variables), perm_type="column")
    variable_of = np.empty(len(rows), dtype=int)
    variable_of[order] = found
    equation_of = np.full(n_variables, -1)
    matched = np.flatnonzero(variable_of >= 0)
    equation_of[variable_of[matched]] = matched
    return Matching(variable_of.tolist(), equation_of.tolist())


def augment(
    start: int,
    adjacency: Sequence[Sequence[int]],
    right_of: list[int],
    left_of: list[int],
    closed: Collection[int] = (),
) -> Search:
    """Match the left vertex `start` too, along a shortest augmenting path (Berge 1957, breadth first).

    Parameters
    ----------
    start : int
        Left vertex without partner.
    adjacency : sequence of sequence of int
        Right vertices next to each left vertex.
    right_of, left_of : list of int
        Partners of the left and of the right vertices, changed in place if a path is found.
    closed : collection of int
        Right vertices from which no free one can be reached.

    """
    reached_from: dict[int, int] = {}
    left = [start]
    for vertex in left:
        for right in adjacency[vertex]:
            if right in reached_from or right in closed:
                continue
            reached_from[right] = vertex
            if left_of[right] < 0:
                _flip(right, reached_from, right_of, left_of)
                return Search(True, left, list(reached_from))
            left.append(left_of[right])
    return Search(False, left, list(reached_from))


def _flip(right: int, reached_from: dict[int, int], right_of: list[int], left_of: list[int]) -> None:
    while right >= 0:
        left = reached_from[right]
        left_of[right], right_of[left], right = left, right, right_of[left]
