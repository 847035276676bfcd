"""The directions that the constraints leave free, in terms of as many states."""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy

from acausal.policy import POLICY
from acausal.solve.points import Point
from acausal.solve.problem import Problem
from acausal.solve.start.rank import null_space, pivots

# Columns in one call of a sparse solver.
AT_ONCE = 64


def tangent(problem: Problem, at: Point) -> tuple[np.ndarray, np.ndarray]:
    """Choose independent states, and say how all states follow from small changes of them.

    Returns
    -------
    N : array, shape (nx, n)
        Changes of all states for a unit change of each independent one; all constraints hold along them.
    chosen : array of int, shape (n,)
        The independent states, those along which the motion is largest, coordinates with their rates.
    """
    if not problem.compiled.constraints.size:
        return np.eye(problem.nx), np.arange(problem.nx)
    J, size = problem.gradients(at), problem.nominal[: problem.nx]
    null = null_space(J)
    rate_of = dict(problem.rates)
    # Whatever no constraint holds stays a state of its own, before all others; coordinates come before their rates.
    weight = np.where(np.isin(np.arange(problem.nx), J.nonzero()[1]), 1.0, POLICY.ranks.unheld)
    weight[[k for k in rate_of if weight[k] == 1.0]] = POLICY.ranks.coordinate
    order = pivots(null * weight)
    first = [k for k in order[: len(null)] if k not in rate_of.values()]
    paired = np.array(sorted({*first, *(rate_of[k] for k in first if k in rate_of)}), dtype=int)
    fits = len(paired) == len(null) and (not len(null) or np.linalg.matrix_rank(null[:, paired]) == len(null))
    chosen = paired if fits else np.sort(order[: len(null)])
    return size[:, None] * np.linalg.solve(null[:, chosen], null).T / size[chosen], chosen


def state_matrix(J: Any, nx: int) -> np.ndarray:
    """Eliminate the algebraic unknowns: A = f_x - f_z g_z^-1 g_x, dense."""
    own, f_z, right, solve = _split(J, nx)
    return own.toarray() - f_z @ solve(right.toarray()) if solve else own.toarray()


def state_slopes(J: Any, nx: int, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Entries (rows[k], columns[k]) of what `state_matrix` returns, some columns at a time."""
    own, f_z, right, solve = _split(J, nx)
    found = np.asarray(own[rows, columns]).ravel()
    for first in range(0, len(rows) if solve else 0, AT_ONCE):
        some = slice(first, first + AT_ONCE)
        dz = solve(right[:, columns[some]].toarray())
        found[some] -= np.asarray(f_z[rows[some]].multiply(dz.T).sum(axis=1)).ravel()
    return found


def _split(J: Any, nx: int) -> tuple[Any, Any, Any, Any]:
    """Return f_x, f_z, g_x, and a solver with g_z if there are algebraic unknowns."""
    J = scipy.sparse.csc_matrix(J)
    f, g = J[:nx], J[nx:]
    solve = scipy.sparse.linalg.splu(g[:, nx:].tocsc()).solve if g.shape[0] else None
    return f[:, :nx], f[:, nx:].tocsr(), g[:, :nx], solve
