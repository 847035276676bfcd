"""Selection of conditions that complete a system, for instance at the start time."""

from __future__ import annotations

from dataclasses import dataclass

from acausal.structure.incidence import Rows
from acausal.structure.matching import augment, maximum_matching


@dataclass(frozen=True)
class Completion:
    """Conditions that complete a system, and those that do not.

    Parameters
    ----------
    used : tuple of int
        Positions of the conditions that are needed.
    surplus : tuple of int
        Positions of conditions that the others imply or contradict.
    free : tuple of int
        Variables that remain undetermined.

    """

    used: tuple[int, ...]
    surplus: tuple[int, ...]
    free: tuple[int, ...]


def complete(equations: Rows, conditions: Rows, n_variables: int) -> Completion:
    """Add conditions to equations in order, each if it determines one more variable.

    Parameters
    ----------
    equations : rows
        Variables of each equation; all equations are used.
    conditions : rows
        Variables of each condition, in order of importance.
    n_variables : int
        Number of variables.

    """
    matching = maximum_matching(equations, n_variables)
    rows = [*equations, *conditions]
    variable_of = matching.variable_of + [-1] * len(conditions)
    exhausted: set[int] = set()
    used, surplus = [], []
    for k in range(len(conditions)):
        search = augment(len(equations) + k, rows, variable_of, matching.equation_of, exhausted)
        (used if search.found else surplus).append(k)
        if not search.found:
            exhausted.update(search.right)
    free = tuple(v for v, e in enumerate(matching.equation_of) if e < 0)
    return Completion(tuple(used), tuple(surplus), free)
