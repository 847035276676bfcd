"""Dulmage-Mendelsohn decomposition into over-, well- and under-determined parts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import scipy

from acausal.structure.incidence import Rows, sparse, transpose
from acausal.structure.matching import maximum_matching
from acausal.structure.singularity import Subsystem


@dataclass(frozen=True)
class DulmageMendelsohn:
    """The three parts of the coarse decomposition, which do not depend on the matching."""

    over: Subsystem
    well: Subsystem
    under: Subsystem


def decompose(rows: Rows, n_variables: int) -> DulmageMendelsohn:
    """Return the coarse decomposition from a maximum matching (Dulmage & Mendelsohn 1958; Pothen & Fan 1990)."""
    matching = maximum_matching(rows, n_variables)
    free_equations = [e for e, variable in enumerate(matching.variable_of) if variable < 0]
    free_variables = [v for v, equation in enumerate(matching.equation_of) if equation < 0]
    over = Subsystem.of(*_reach(free_equations, rows, matching.equation_of))
    columns = transpose(rows, n_variables) if free_variables else []
    variables, equations = _reach(free_variables, columns, matching.variable_of)
    under = Subsystem.of(equations, variables)
    well = Subsystem.of(
        set(range(len(rows))).difference(over.equations, under.equations),
        set(range(n_variables)).difference(over.variables, under.variables),
    )
    return DulmageMendelsohn(over, well, under)


def components(rows: Rows, part: Subsystem) -> tuple[Subsystem, ...]:
    """Return the connected components of `part`, smallest first (ties: lowest equation, then lowest variable)."""
    position = {variable: len(part.equations) + k for k, variable in enumerate(part.variables)}
    n = len(position) + len(part.equations)
    graph = [[position[v] for v in rows[e] if v in position] for e in part.equations] + [[] for _ in position]
    count, labels = scipy.sparse.csgraph.connected_components(sparse(graph, n), directed=False)
    found: list[tuple[list[int], list[int]]] = [([], []) for _ in range(count)]
    for label, equation in zip(labels, part.equations, strict=False):
        found[label][0].append(equation)
    for label, variable in zip(labels[len(part.equations) :], part.variables, strict=True):
        found[label][1].append(variable)
    found.sort(key=lambda item: (len(item[0]) + len(item[1]), item))
    return tuple(Subsystem.of(*item) for item in found)


def _reach(free: Iterable[int], adjacency: Rows, partner: Sequence[int]) -> tuple[list[int], set[int]]:
    """Return the vertices on alternating paths from `free` vertices, on their side and on the other side."""
    own, other = list(free), set()
    for vertex in own:
        for neighbour in adjacency[vertex]:
            if neighbour not in other:
                other.add(neighbour)
                own.append(partner[neighbour])
    return own, other
