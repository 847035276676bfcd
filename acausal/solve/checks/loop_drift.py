"""Drift of the redundant constraints of closed loops in a run."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.looks import spread
from acausal.solve.point import Rows


def loop_drift(consistent: Consistent, rows: Rows) -> list[str]:
    """Return warnings on loops that open in a run because a redundant constraint no longer follows from the others.

    Parameters
    ----------
    consistent : Consistent
        Solver for the algebraic unknowns of the run.
    rows : Rows
        Rows of the run, of which a sample is checked, including the last one.
    """
    problem = consistent.problem
    flat, c = problem.compiled.reduced.flat, problem.compiled.constraints
    if not c.closures:
        return []
    some = rows[spread(len(rows), POLICY.loops.seen)]
    off = np.any(problem.compiled.layout.closures_of(some.constants) == 0, axis=0)
    redundant = [k for k in np.flatnonzero(off).tolist() if flat.loops.closures[k].loop >= 0]
    if not redundant:
        return []
    some, _ = consistent(some)
    points = [problem.projected(problem.point(some, place)) for place in range(len(some))]
    residuals = np.nan_to_num(np.abs([problem.constraints(at)[0] for at in points]))
    drifts: dict[int, tuple[float, float]] = {}
    for k in redundant:
        row = c.lowest[c.closures[k]]
        place = int(np.argmax(residuals[:, row]))
        worst, size = points[place], float(residuals[place, row])
        if size > POLICY.loops.opened * problem.residual_scales(worst)[row]:
            loop = flat.loops.closures[k].loop
            drifts[loop] = max(drifts.get(loop, (0.0, 0.0)), (size, worst.time))
    return [
        f"the loop that {flat.loops.cuts[loop].a} and {flat.loops.cuts[loop].b} close ({flat.loops.cuts[loop].where}) is open by "
        f"{size:.2g} m or rad at t = {time:.4g} s: a constraint that was redundant at the start is independent there, and "
        "is not satisfied. Start from another position."
        for loop, (size, time) in drifts.items()
    ]
