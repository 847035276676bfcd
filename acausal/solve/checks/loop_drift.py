"""Whether loops whose constraints were taken as redundant stay closed in a run."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.looks import spread
from acausal.solve.point import Rows


def opened(consistent: Consistent, rows: Rows) -> list[str]:
    """Name loops that open in a run although what closes them seemed to follow from other constraints.

    Parameters
    ----------
    consistent : Consistent
        Of the run.
    rows : Rows
        Of the run, of which some are looked at, the last one among them.
    """
    problem = consistent.problem
    flat, c = problem.compiled.reduced.flat, problem.compiled.constraints
    if not c.closures:
        return []
    some = rows[spread(len(rows), POLICY.loops.seen)]
    off = np.any(problem.compiled.layout.closures_of(some.constants) == 0, axis=0)
    dropped = [k for k in np.flatnonzero(off).tolist() if flat.loops.closures[k].loop >= 0]
    if not dropped:
        return []
    some, _ = consistent(some)
    points = [problem.projected(problem.point(some, place)) for place in range(len(some))]
    apart = np.nan_to_num(np.abs([problem.constraints(at)[0] for at in points]))
    wide: dict[int, tuple[float, float]] = {}
    for k in dropped:
        row = c.lowest[c.closures[k]]
        place = int(np.argmax(apart[:, row]))
        widest, size = points[place], float(apart[place, row])
        if size > POLICY.loops.opened * problem.residual_scales(widest)[row]:
            loop = flat.loops.closures[k].loop
            wide[loop] = max(wide.get(loop, (0.0, 0.0)), (size, widest.time))
    return [
        f"the loop that {flat.loops.cuts[loop].a} and {flat.loops.cuts[loop].b} close ({flat.loops.cuts[loop].where}) is open by "
        f"{size:.2g} m or rad at t = {time:.4g} s: a constraint that followed from the others at the start does not follow "
        "from them there, and was not kept. Start from another position."
        for loop, (size, time) in wide.items()
    ]
