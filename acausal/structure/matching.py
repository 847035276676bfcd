"""Maximum bipartite matching, at once and by one more vertex."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from acausal.structure.incidence import Rows


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
class Augmentation:
    """Outcome of one search for a path: whether it found one, and the vertices of both sides that it visited."""

    found: bool
    left: list[int]
    right: list[int]


def maximum_matching(rows: Rows, n_variables: int) -> Matching:
    """Match as many equations as possible: short ones first, each with the first free variable, then by augmenting paths.

    The search of scipy for all at once takes exponentially long on some chains.
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
    """Match the left vertex `start` too, along a shortest augmenting path (Berge 1957, breadth first).

    Parameters
    ----------
    start : int
        Left vertex without partner.
    adjacency : sequence of sequence of int
        Right vertices next to each left vertex.
    right_of, left_of : list of int
        Partners of the left and of the right vertices, changed in place if a path is found.
    exhausted : collection of int
        Right vertices from which no free one can be reached.

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
