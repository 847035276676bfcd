"""Positions in which the constraints of closed loops are not independent: flat ones, where two ways to go on meet."""

from __future__ import annotations

import numpy as np

from acausal.compiler.constants import Constants
from acausal.policy import POLICY
from acausal.solve.hermite import cubic
from acausal.solve.initialization.independent_constraints import IndependentConstraints
from acausal.solve.looks import spread
from acausal.solve.point import Rows
from acausal.solve.problem import Problem

LOOPS = POLICY.loops


def looked_at(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> IndependentConstraints:
    """Return the constraints at successive steps, or at some of them: see `looks`."""
    some = looks(problem, len(times))
    return IndependentConstraints(problem, times[some], x[some], constants)


def passes_flat(held: IndependentConstraints) -> bool:
    """Return whether loops may have passed a position in which their constraints are not independent, between steps.

    There the smallest singular value of their Jacobian is 0. It falls linearly on the way, so it may have been 0 between two
    steps where it is less at one of them than it changes from one to the other. Another method goes on then, so that a false
    alarm costs time alone; `flat_time`, and `flat.c` in an exported model, look for the least value within the step.
    """
    return bool(_alarms(held.smallest_singular_values).any())


def flat_time(problem: Problem, times: np.ndarray, y: np.ndarray, constants: Constants) -> float | None:
    """Return the time in s at which loops first pass such a position, None if they pass none.

    Where `passes_flat` is alarmed, and beside it, as it may be 0 amid a step from one side to the other, the least value is
    looked for on the cubic between the steps.

    Parameters
    ----------
    problem : Problem
        The model.
    times, y : arrays, shapes (n,), (n, nx + nz)
        Times, states and algebraic unknowns of successive steps.
    constants : Constants
        Those of the segment.
    """
    some = looks(problem, len(times))
    times, (x, z) = times[some], np.split(y[some], [problem.nx], axis=1)
    alarms = np.pad(_alarms(IndependentConstraints(problem, times, x, constants).smallest_singular_values), 1)
    for k in np.flatnonzero(alarms[:-2] | alarms[1:-1] | alarms[2:]).tolist():
        two = slice(k, k + 2)
        rates = problem.each(problem.compiled.rates, Rows.within(times[two], x[two], z[two], constants.vector))
        h, low, high = times[k + 1] - times[k], 0.0, 1.0
        for _ in range(LOOPS.zooms):
            parts = np.linspace(low, high, LOOPS.parts + 1)
            inside = cubic(parts[:, None], h, x[two], rates)[0]
            least = np.min(
                IndependentConstraints(problem, times[k] + parts * h, inside, constants).smallest_singular_values,
                axis=0,
            )
            place = int(np.argmin(least))
            if least[place] <= LOOPS.flat:
                return float(times[k] + parts[place] * h)
            low, high = parts[max(place - 1, 0)], parts[min(place + 1, LOOPS.parts)]
    return None


def looks(problem: Problem, n: int) -> np.ndarray:
    """Places among n steps: all but in large mechanisms, where each look costs much."""
    most = POLICY.calls.work / problem.compiled.constraints.size**3
    return spread(n, int(np.clip(most, POLICY.calls.looks[0], n)))


def _alarms(least: np.ndarray) -> np.ndarray:
    """Whether any of some values, shape (m, n), may be 0 between each point and the next."""
    return np.any(np.minimum(least[:, 1:], least[:, :-1]) <= np.abs(np.diff(least)), axis=0)
