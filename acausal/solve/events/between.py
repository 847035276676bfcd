"""Values between two points of a run, from the cubic that has their states and rates (Hermite)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.hermite import cubic
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.energy import between_rows
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows

BETWEEN = POLICY.between


@dataclass(frozen=True)
class Between:
    """Points between two others.

    Attributes
    ----------
    rows : Rows
        n points with consistent algebraic unknowns.
    defect : array, shape (n,)
        How much the states would be off at the end if their rates were off all the way as they are there, as a fraction of
        what the tolerance allows (defect control, Enright 1989).
    """

    rows: Rows
    defect: np.ndarray


def between(integrator: Integrator, ends: Rows, times: np.ndarray) -> Between:
    """Interpolate.

    Parameters
    ----------
    integrator : Integrator
        With model, parameters and tolerance.
    ends : Rows
        The two points, with algebraic unknowns nearly right; the constants are those of the first.
    times : array, shape (n,)
        Times between them.
    """
    h = ends.times[1] - ends.times[0]
    s = ((times - ends.times[0]) / h)[:, None]
    constants = ends.constants[0]
    ends, lost = integrator.consistent(Rows.within(ends.times, ends.x, ends.z, constants))
    x, slope = cubic(s, h, ends.x, integrator.consistent.rates(ends))
    nearly = ends.z[0] + s * (ends.z[1] - ends.z[0])
    found, failed = integrator.consistent(Rows.within(times, x, nearly, constants))
    weights = integrator.tolerance * (np.abs(x) + integrator.settings.nominal[: integrator.compiled.nx])
    defect = np.max(np.abs(slope - integrator.consistent.rates(found)) * h / weights, axis=1, initial=0.0)
    return Between(found, np.full(len(times), np.inf) if lost or failed else np.nan_to_num(defect, nan=np.inf))


def work_between(integrator: Integrator, at: Point, end: Point) -> np.ndarray:
    """Integrals of the supplied and of the dissipated power in J from one point of a segment to another."""
    if not integrator.settings.energy or integrator.compiled.powers.is_zero() or end.time <= at.time:
        return np.zeros(2)
    ends = Rows.of(at, end)
    looks = np.linspace(at.time, end.time, BETWEEN.looks + 2)[1:-1]
    if np.all(between(integrator, ends, looks).defect <= BETWEEN.faithful):
        found, known = between_rows(integrator.consistent, ends, integrator.tolerance)
        if known:
            return found[-1]
    leg = integrator.attempt(at, ends.times, replace(integrator.way, max_steps=BETWEEN.most_steps, careful=True))
    if isinstance(leg, Leg):
        return leg.energy[-1]
    return between_rows(integrator.consistent, ends, integrator.tolerance)[0][-1]
