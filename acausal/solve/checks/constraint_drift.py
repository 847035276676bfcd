"""Drift of redundant constraints of components in a run."""

from __future__ import annotations

import numpy as np

from acausal.errors import SimulationError
from acausal.policy import POLICY
from acausal.solve.checks.separation import Violation, first_coincidence
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.looks import spread
from acausal.solve.point import Point, Rows


def first_violation(integrator: Integrator, first: Point) -> Violation | None:
    """Return the earlier of the first coincidence of points and the first drift of constraints; None if neither occurs."""
    found = (first_coincidence(integrator, first), first_constraint_drift(integrator, first))
    return min(filter(None, found), key=lambda end: end.time, default=None)


def refuse_constraint_drift(integrator: Integrator, first: Point) -> None:
    """Raise SimulationError if a redundant constraint of a component is violated, see `first_constraint_drift`."""
    if found := first_constraint_drift(integrator, first):
        raise SimulationError(found.text)


def first_constraint_drift(integrator: Integrator, first: Point) -> Violation | None:
    """Return the first violation of redundant constraints of components, None if there is none.

    Parameters
    ----------
    integrator : Integrator
        With the results of the run.
    first : Point
        The first row of the run.
    """
    loops, rows = integrator.compiled.reduced.flat.loops, integrator.trace.rows(first)
    dropped = integrator.compiled.layout.closures_of(rows.constants) == 0 if loops.of_parts else np.zeros((0, 0))
    watched = [k for k in loops.of_parts if dropped[:, k].any()]
    if not watched:
        return None
    some, before = spread(len(rows), POLICY.loops.seen), 0
    for place in some.tolist():
        if _broken(integrator, rows, place, watched):
            break
        before = place
    else:
        return None
    place = next(k for k in range(before, place + 1) if _broken(integrator, rows, k, watched))
    return Violation(float(rows.times[place]), _text(integrator, rows, place, watched))


def _broken(integrator: Integrator, rows: Rows, place: int, watched: list[int]) -> list[tuple[int, float]]:
    """Return the redundant closures that are violated at a row, and their residuals."""
    problem, c = integrator.problem, integrator.compiled.constraints
    found, _ = integrator.consistent(rows[place : place + 1])
    at = problem.projected(problem.point(found, 0))
    off, sizes = np.abs(problem.constraints(at)[0]), problem.residual_scales(at)
    lowest = {k: c.lowest[c.closures[k]] for k in watched if at.constants.closures[k] == 0}
    return [(k, float(off[row])) for k, row in lowest.items() if not off[row] <= POLICY.loops.opened * sizes[row]]


def _text(integrator: Integrator, rows: Rows, place: int, watched: list[int]) -> str:
    flat = integrator.compiled.reduced.flat
    broken = _broken(integrator, rows, place, watched)
    time = float(rows.times[place])
    lines = [f"  {flat.equations.origins[flat.loops.closures[k].row]}: violated by {size:.2g}" for k, size in broken]
    which = "a redundant constraint no longer follows" if len(lines) == 1 else "redundant constraints no longer follow"
    return "\n".join(
        [
            f"the run stopped at t = {time:.6g} s: {which} from the others:",
            *lines,
            "No motion may satisfy all constraints there. Replace the constraint of one part by a spring and a damper, or start "
            "from a position in which the constraints are independent.",
        ]
    )
