"""Positions in which the constraints of closed loops are not independent: flat ones, where two ways to go on meet."""

from __future__ import annotations

import numpy as np

from acausal.compiler.constants import Constants
from acausal.compiler.constraints import Constraints
from acausal.policy import POLICY
from acausal.solve.hermite import cubic
from acausal.solve.looks import spread
from acausal.solve.points import Rows
from acausal.solve.problem import Problem
from acausal.solve.start.parts import Part
from acausal.solve.start.reach import held_in_sizes, levels_of
from acausal.solve.start.regular import least_singular_value

LOOPS = POLICY.loops


def passes_flat(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> bool:
    """Return whether loops may have passed a position in which their constraints are not independent.

    There the smallest singular value of their Jacobian is 0. It falls linearly on the way, so it may have been 0 between two
    steps where it is less at one of them than it changes from one to the other. Another method goes on then, so that a false
    alarm costs time alone; `flat_time`, and `flat.c` in an exported model, look for the least value within the step.

    Parameters
    ----------
    problem : Problem
        The model.
    times, x : arrays, shapes (n,), (n, nx)
        Times and states of successive steps.
    constants : Constants
        Those of the segment.
    """
    some = _looks(problem, len(times))
    return bool(_alarms(_least(problem, times[some], x[some], constants)).any())


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
    some = _looks(problem, len(times))
    times, (x, z) = times[some], np.split(y[some], [problem.nx], axis=1)
    alarms = np.pad(_alarms(_least(problem, times, x, constants)), 1)
    for k in np.flatnonzero(alarms[:-2] | alarms[1:-1] | alarms[2:]).tolist():
        two = slice(k, k + 2)
        rates = problem.each(problem.compiled.rates, Rows.within(times[two], x[two], z[two], constants.vector))
        h, low, high = times[k + 1] - times[k], 0.0, 1.0
        for _ in range(LOOPS.zooms):
            parts = np.linspace(low, high, LOOPS.parts + 1)
            inside = cubic(parts[:, None], h, x[two], rates)[0]
            least = np.min(_least(problem, times[k] + parts * h, inside, constants), axis=0)
            place = int(np.argmin(least))
            if least[place] <= LOOPS.flat:
                return float(times[k] + parts[place] * h)
            low, high = parts[max(place - 1, 0)], parts[min(place + 1, LOOPS.parts)]
    return None


def _looks(problem: Problem, n: int) -> np.ndarray:
    """Places among n steps: all but in large mechanisms, where each look costs much."""
    most = POLICY.calls.work / problem.compiled.constraints.size**3
    return spread(n, int(np.clip(most, POLICY.calls.looks[0], n)))


def _alarms(least: np.ndarray) -> np.ndarray:
    """Whether any of some values, shape (m, n), may be 0 between each point and the next."""
    return np.any(np.minimum(least[:, 1:], least[:, :-1]) <= np.abs(np.diff(least)), axis=0)


def _least(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> np.ndarray:
    """Smallest singular values of the parts of the constraints at n points, shape (m, n)."""
    c = problem.compiled.constraints
    counts = c.counting(constants.closures) & c.is_lowest
    held, _ = held_in_sizes(problem, x, times, constants.vector)
    held = held / _sizes(c, held)
    parts = [(part, counts[part.rows]) for part in levels_of(problem.compiled)]
    found = [_smallest(part, held, on) for part, on in parts if on.any()]
    return np.array(found).reshape(len(found), len(times))


def _smallest(part: Part, held: np.ndarray, on: np.ndarray) -> np.ndarray:
    """Smallest singular values of some rows of a part, to 1e-8 of the largest: the roots of eigenvalues of A A', or of A' A."""
    if np.sum(on) > POLICY.ranks.small:
        return np.array([least_singular_value(part.sparse(row)[on]) for row in held])
    A = part.dense(held)[:, on]
    turned = A.transpose(0, 2, 1)
    square = A @ turned if A.shape[1] <= A.shape[2] else turned @ A
    return np.sqrt(np.maximum(np.linalg.eigvalsh(square)[:, 0], 0.0))


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
