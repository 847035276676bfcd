"""Choice of the states, and the equation that each other variable is matched with."""

from __future__ import annotations

from acausal.structure.incidence import chains, transpose
from acausal.structure.matching import Matching, augment, maximum_matching
from acausal.structure.singularity import Part, StructuralSingularity
from acausal.structure.system import System


def match_algebraic(system: System) -> Matching:
    """Match all equations; the variables left over are the states (dummy derivatives, Mattsson & Soderlind 1993).

    The sets of variables that can be matched together are the independent sets of a matroid, hence a greedy choice
    is a best one. A variable may be algebraic only if its derivative is.

    Raises
    ------
    StructuralSingularity
        If equations stay unmatched (a declared derivative contradicts the equations).

    """
    derivative = system.derivative
    highest = [[v for v in row if derivative[v] < 0] for row in system.rows]
    matching = maximum_matching(highest, system.n_variables)
    unmatched = matching.variable_of.count(-1)
    columns = transpose(system.rows, system.n_variables) if unmatched else []
    # No free equation can be reached from what a failed search visited, now or later.
    closed: set[int] = set()
    for variable in _candidates(system) if unmatched else ():
        if matching.equation_of[derivative[variable]] < 0:
            continue
        search = augment(variable, columns, matching.equation_of, matching.variable_of, closed)
        if not search.found:
            closed.update(search.right)
            continue
        unmatched -= 1
        if not unmatched:
            break
    if unmatched:
        left = [e for e, variable in enumerate(matching.variable_of) if variable < 0]
        raise StructuralSingularity(over=(Part.of(left, (v for e in left for v in system.rows[e])),))
    return matching


def _candidates(system: System) -> list[int]:
    """Variables with a derivative in the order in which they are tried as algebraic ones."""
    keyed = []
    for chain in chains(system.derivative):
        preferences = [system.preference[v] for v in reversed(chain)]
        for level, variable in enumerate(reversed(chain)):
            if level:
                # Equal preferences are decided by those of the variables that become candidates next.
                keyed.append((level, preferences[level:], -variable))
    return [-key[-1] for key in sorted(keyed)]
