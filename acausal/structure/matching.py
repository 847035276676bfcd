"""Maximum bipartite matching, and its augmentation by one vertex."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from acausal.structure.incidence import Rows


@dataclass(frozen=True)
class Matching:
    """Matched pairs of equations and variables; -1 for an unmatched one.

    Parameters
    ----------
    variable_of : list of int, shape (n_equations,)
    equation_of : list of int, shape (n_variables,)

    """

    variable_of: list[int]
    equation_of: list[int]


@dataclass(frozen=True)
class Augmentation:
    """Result of a search for an augmenting path: its success, and the visited vertices of both sides."""

    found: bool
    left: list[int]
    right: list[int]


def maximum_matching(rows: Rows, n_variables: int) -> Matching:
    """Return a maximum matching: greedy with short equations first, then by augmenting paths.

    The algorithm of scipy takes exponential time on some chains.
    """
    matching = Matching([-1] * len(rows), [-1] * n_variables)
    alone = []
    for equation in sorted(range(len(rows)), key=lambda k: len(rows[k])):
        free = next((v for v in rows[equation] if matching.equation_of[v] < 0), None)
        if free is None:
            alone.append(equation)
        else:
            matching.variable_of[equation], matching.equation_of[free] = free, equation
    exhausted: set[int] = set()
    for equation in alone:
        search = augment(equation, rows, matching.variable_of, matching.equation_of, exhausted)
        if not search.found:
            exhausted.update(search.right)
    return matching


def augment(
    start: int,
    adjacency: Sequence[Sequence[int]],
    right_of: list[int],
    left_of: list[int],
    exhausted: Collection[int] = (),
) -> Augmentation:
    """Match the left vertex `start` along a shortest augmenting path (Berge 1957; breadth-first search).

    Parameters
    ----------
    start : int
        Unmatched left vertex.
    adjacency : sequence of sequence of int
        Right neighbours of each left vertex.
    right_of, left_of : list of int
        Partners of the left and of the right vertices, changed in place if a path is found.
    exhausted : collection of int
        Right vertices from which no unmatched one can be reached.

    """
    reached_from: dict[int, int] = {}
    left = [start]
    for vertex in left:
        for right in adjacency[vertex]:
            if right in reached_from or right in exhausted:
                continue
            reached_from[right] = vertex
            if left_of[right] < 0:
                _flip(right, reached_from, right_of, left_of)
                return Augmentation(True, left, list(reached_from))
            left.append(left_of[right])
    return Augmentation(False, left, list(reached_from))


def _flip(right: int, reached_from: dict[int, int], right_of: list[int], left_of: list[int]) -> None:
    while right >= 0:
        left = reached_from[right]
        left_of[right], right_of[left], right = left, right, right_of[left]
