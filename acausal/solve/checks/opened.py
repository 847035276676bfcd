"""Whether loops whose constraints were taken as redundant are closed where a run ends."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.points import Rows
from acausal.solve.problem import Problem


def opened(problem: Problem, rows: Rows, dropped: tuple[int, ...]) -> list[str]:
    """Name loops that are open at the end of a run although what closes them seemed to follow from other constraints.

    Parameters
    ----------
    problem : Problem
        The model.
    rows : Rows
        Of the run; the algebraic unknowns of the last one satisfy their equations.
    dropped : tuple of int
        Constraints that follow from others, as their ranks told at the start.
    """
    if not dropped:
        return []
    flat, c = problem.compiled.reduced.flat, problem.compiled.constraints
    at = problem.projected(problem.point(rows[-1:], 0))
    gap, apart = np.abs(problem.gaps(at)), np.abs(problem.constraints(at)[0])
    wide: dict[int, float] = {}
    for k in dropped:
        row = int(c.lowest[k])
        if gap[row] > POLICY.loops.opened and k in c.closures:
            loop = flat.loops.closures[c.closures.index(k)].loop
            wide[loop] = max(wide.get(loop, 0.0), float(apart[row]))
    return [
        f"the loop that {flat.loops.cuts[loop].a} and {flat.loops.cuts[loop].b} close ({flat.loops.cuts[loop].where}) is open by "
        f"{size:.2g} m or rad at t = {at.time:.4g} s: a constraint that followed from the others at the start does not follow "
        "from them there, and was not kept. Start from another position."
        for loop, size in wide.items()
    ]
