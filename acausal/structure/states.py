"""State selection and matching of the algebraic variables."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from acausal.structure.incidence import chains, transpose
from acausal.structure.matching import augment, maximum_matching
from acausal.structure.system import System


@dataclass(frozen=True)
class StateSelection:
    """Equation of each algebraic variable, and the unmatched equations."""

    equation_of: list[int]
    left: list[int]

    @property
    def states(self) -> tuple[int, ...]:
        """Variables without an equation, ascending."""
        return tuple(v for v, equation in enumerate(self.equation_of) if equation < 0)


def select_states(
    system: System,
    lower: Collection[int],
    apart: Collection[int] = (),
    constant: bool = True,
    integrated: Collection[int] = (),
) -> StateSelection:
    """Match the equations; the unmatched variables are the states (dummy derivatives, Mattsson & Soderlind 1993).

    The sets of variables that can be matched simultaneously are the independent sets of a matroid, so a greedy choice
    is optimal. A variable may be algebraic only if its derivative is.

    Parameters
    ----------
    system : System
        The extended system.
    lower : collection of int
        Equations whose derivative is in the system: they are not matched with highest derivatives.
    apart : collection of int
        Equations to exclude.
    constant : bool
        True if a variable may be algebraic only through constant coefficients that are not small: other choices could
        become singular during the run, or amplify round-off.
    integrated : collection of int
        Variables that must be states.

    """
    derivative = system.derivative
    out = set(lower).union(apart)
    highest = [() if e in out else [v for v in row if derivative[v] < 0] for e, row in enumerate(system.rows)]
    matching = maximum_matching(highest, system.n_variables)
    unmatched = [e for e, v in enumerate(matching.variable_of) if v < 0 and e not in apart]
    ties = [sorted(x) for x in system.pivots] if constant else system.rows
    columns = transpose([() if e in apart else x for e, x in enumerate(ties)], system.n_variables)
    # Vertices visited by a failed search never lead to a free equation, now or later.
    exhausted: set[int] = set(apart)
    for variable in _candidates(system) if unmatched else ():
        if variable in integrated or matching.equation_of[derivative[variable]] < 0:
            continue
        search = augment(variable, columns, matching.equation_of, matching.variable_of, exhausted)
        if not search.found:
            exhausted.update(search.right)
            continue
        unmatched = [e for e in unmatched if matching.variable_of[e] < 0]
        if not unmatched:
            break
    return StateSelection(matching.equation_of, unmatched)


def _candidates(system: System) -> list[int]:
    """Return the variables with a derivative, in the order in which they are tried as algebraic variables."""
    keyed = []
    for chain in chains(system.derivative):
        preferences = [system.preference[v] for v in reversed(chain)]
        for level, variable in enumerate(reversed(chain)):
            if level:
                # Equal preferences: compare those of the next candidates in the chain.
                keyed.append((level, preferences[level:], -variable))
    return [-key[-1] for key in sorted(keyed)]
