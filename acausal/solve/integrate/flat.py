"""Positions in which the constraints of closed loops are not independent: flat ones, where two ways to go on meet."""

from __future__ import annotations

import numpy as np

from acausal.compiler.constants import Constants
from acausal.solve.problem import Problem


def passes_flat(problem: Problem, times: np.ndarray, x: np.ndarray, constants: Constants) -> bool:
    """Return whether loops may have passed a position in which their constraints are not independent.

    There the smallest singular value of their Jacobian is 0. It falls linearly on the way, so it may have been 0 between two
    steps where it is less at one of them than it changes from one to the other.

    Parameters
    ----------
    problem : Problem
        The model.
    times, x : arrays, shapes (n,), (n, nx)
        Times and states of successive steps.
    constants : Constants
        Those of the segment.
    """
    c = problem.compiled.constraints
    counts = np.ones(len(c.rows), dtype=bool)
    counts[c.closures] = constants.closures > 0
    rows = [own[0] for own, on in zip(c.rows, counts, strict=True) if on]
    J = c.held(x, problem.p, times, constants.vector)[:, rows][:, :, c.states] * problem.nominal[c.states]
    size = np.linalg.norm(J, axis=2, keepdims=True)
    least = np.linalg.svd(J / np.where(size > 0, size, 1.0), compute_uv=False)[:, -1]
    return bool(np.any(np.minimum(least[1:], least[:-1]) <= np.abs(np.diff(least))))
