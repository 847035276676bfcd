"""Models without states: nothing is integrated, the equations are solved at each output."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.diagnosis.singularity import undetermined
from acausal.solve.initialization.newton import algebraic
from acausal.solve.integrate.consistent import Consistent
from acausal.solve.integrate.energy import between_rows
from acausal.solve.integrate.ladder import Failure, Kind, Refusal
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem


def everywhere(solver: Consistent, at: Point, times: np.ndarray, tolerance: float | None) -> Leg | Refusal:
    """Go from output to output where there is nothing to integrate.

    Parameters
    ----------
    solver : Consistent
        As of `powers`.
    at : Point
        Where it begins.
    times : array, shape (n + 1,)
        Times in s, that of the point first.
    tolerance : float or None
        Of the energies; None leaves them 0.
    """
    compiled, constants, found = solver.compiled, at.constants, [at.z]
    for time in times[1:]:
        try:
            at = _solved(solver.problem, replace(at, time=float(time)))
        except InitializationError:
            return Refusal(Kind.UNSOLVABLE, float(time))
        found.append(at.z)
    n = len(times) - 1
    rows, energy = Rows.within(times, np.zeros((n + 1, 0)), np.array(found), constants.vector), np.zeros((n, 2))
    if tolerance is not None and not compiled.powers.is_zero():
        energy = between_rows(solver, rows, tolerance)[0][1:]
    return Leg(rows[1:], energy, constants, 0)


def _solved(problem: Problem, at: Point) -> Point:
    """Return the point with its algebraic unknowns; what the core does not solve for at once may be open at this time."""
    if found := problem.solved(at, POLICY.newton.quick):
        return found
    found = algebraic(problem, at)
    if text := undetermined(problem, found):
        raise Failure(at.time, text)
    return found
