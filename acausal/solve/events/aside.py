"""Integrations beside a run, through its laws and without its events."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.solve.events.hybrid import Hybrid
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Refusal
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows


def integrate_aside(integrator: Integrator, at: Point, times: np.ndarray, most: int) -> Leg | Refusal:
    """Integrate from a point through all other times, in the way of a run.

    Parameters
    ----------
    integrator : Integrator
        Counts for itself from here on.
    at : Point
        Point at times[0].
    times : array, shape (n + 1,)
        Times in s.
    most : int
        Steps between two times at most.
    """
    integrator.way = replace(integrator.way, max_steps=most)
    hybrid, rows, first = Hybrid(integrator, None, times), list[Rows](), at
    while at.time < times[-1]:
        passed = hybrid.go(at, float(times[-1]), 0)
        if passed.refusal:
            return passed.refusal
        rows += [passed.leg.rows] if passed.leg else []
        at = passed.at
    found = Rows.joined(rows)
    return Leg(found, np.zeros((len(found), 2)), first.constants)
