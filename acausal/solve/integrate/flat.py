"""Positions in which the constraints of closed loops are not independent: flat ones, where two ways to go on meet."""

from __future__ import annotations

import numpy as np

from acausal.compiler.constants import Constants
from acausal.compiler.constraints import Constraints
from acausal.policy import POLICY
from acausal.solve.looks import spread
from acausal.solve.problem import Problem
from acausal.solve.start.loop_states import levels_of


def passes_flat(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> bool:
    """Return whether loops may have passed a position in which their constraints are not independent.

    There the smallest singular value of their Jacobian is 0. It falls linearly on the way, so it may have been 0 between two
    steps where it is less at one of them than it changes from one to the other. Another method goes on then, so that a false
    alarm costs time alone; `flat.c` ends the run of an exported model, and first looks for the least value within the step.

    Parameters
    ----------
    problem : Problem
        The model.
    times, x : arrays, shapes (n,), (n, nx)
        Times and states of successive steps.
    constants : Constants
        Those of the segment.
    """
    c, nominal = problem.compiled.constraints, problem.nominal
    counts = c.counting(constants.closures) & c.is_lowest
    some = spread(len(times), int(np.clip(POLICY.calls.work / c.size**3, POLICY.calls.looks[0], len(times))))
    held = c.held(x[some], problem.p, times[some], constants.vector) * nominal[c.entries[1]]
    held = held / _sizes(c, held)
    for part in levels_of(problem.compiled):
        on = counts[part.rows]
        if not on.any():
            continue
        least = np.linalg.svd(part.dense(held)[:, on], compute_uv=False)[:, -1]
        if np.any(np.minimum(least[1:], least[:-1]) <= np.abs(np.diff(least))):
            return True
    return False


def _sizes(c: Constraints, held: np.ndarray) -> np.ndarray:
    """Size of each entry's equation: in a flat position one of its rows may vanish by itself.

    Parameters
    ----------
    c : Constraints
        The constraints.
    held : array, shape (n, entries)
        Their Jacobian at n points.
    """
    rows = c.entries[0]
    lengths = np.zeros((len(held), c.size))
    np.add.at(lengths.T, rows, held.T**2)
    most = np.zeros((len(held), int(np.max(c.kinds, initial=-1)) + 1))
    np.maximum.at(most.T, c.kinds, np.sqrt(lengths.T))
    return np.where(most > 0, most, 1.0)[:, c.kinds[rows]]
