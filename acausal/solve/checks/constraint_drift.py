"""Whether constraints of parts that were taken as redundant still hold in a run."""

from __future__ import annotations

import numpy as np

from acausal.errors import SimulationError
from acausal.policy import POLICY
from acausal.solve.checks.separation import Meeting, first_meeting
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.looks import spread
from acausal.solve.point import Point, Rows


def first_refusal(integrator: Integrator, first: Point) -> Meeting | None:
    """Return the first time at which points meet or constraints of parts stop holding; arguments as those of both."""
    found = (first_meeting(integrator, first), first_departure(integrator, first))
    return min(filter(None, found), key=lambda end: end.time, default=None)


def refuse_departure(integrator: Integrator, first: Point) -> None:
    """Raise SimulationError if constraints of parts stop holding; arguments as of `first_departure`."""
    if found := first_departure(integrator, first):
        raise SimulationError(found.text)


def first_departure(integrator: Integrator, first: Point) -> Meeting | None:
    """Return when constraints of parts that followed from others stop holding, and what to say then.

    Parameters
    ----------
    integrator : Integrator
        What it computed.
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
    return Meeting(float(rows.times[place]), _text(integrator, rows, place, watched))


def _broken(integrator: Integrator, rows: Rows, place: int, watched: list[int]) -> list[tuple[int, float]]:
    """Which closures that do not count are off at a row, and by how much."""
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
            "No motion may satisfy all constraints there. Let one of the parts give way, with a spring and a damper in place of "
            "its constraint; or start from a position in which the constraints are independent.",
        ]
    )
