"""Where the constraints of closed loops that are kept, of some that follow from one another, no longer hold the others."""

from __future__ import annotations

import numpy as np

from acausal.compiler.constants import Constants
from acausal.policy import POLICY
from acausal.solve.integrate.flat import looks
from acausal.solve.points import Rows
from acausal.solve.problem import Problem
from acausal.solve.start.kept import fitness

LOOPS = POLICY.loops


def unfit_time(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants, begin: float) -> float | None:
    """Return a time in s at which other constraints are to be kept, None if those that are stay fit.

    It is that of the last point at which they are fit if they are no longer fairly so there, else between that and the next one.

    Parameters
    ----------
    problem : Problem
        The model.
    times, x : arrays, shapes (n,), (n, nx)
        Times and states of successive steps or outputs.
    constants : Constants
        Those of the segment.
    begin : float
        Time in s at which the call began.
    """
    if constants.all_count:
        return None
    some = looks(problem, len(times))
    times, found = times[some], fitness(problem, times[some], x[some], constants)
    least = LOOPS.unfit * (1.0 if found[0] >= LOOPS.unfit else found[0])
    unfit = np.flatnonzero(found[1:] < least)
    if not unfit.size:
        return None
    before, after = unfit[0], unfit[0] + 1
    if times[before] > begin and found[before] < LOOPS.fairly:
        return float(times[before])
    middle = float((times[before] + times[after]) / 2)
    return middle if middle > begin else None


def fit_rows(problem: Problem, rows: Rows, constants: Constants) -> int:
    """Return the number of rows before the first in which the constraints that are kept are unfit."""
    unfit = fitness(problem, rows.times, rows.x, constants) < LOOPS.unfit
    return int(np.argmax(unfit)) if unfit.any() else len(rows)
