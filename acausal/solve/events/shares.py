"""Linear complementarity problem with bounds: friction forces at rest, as shares of their limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from acausal.policy import POLICY

LAWS = POLICY.laws


@dataclass(frozen=True, eq=False)
class Shares:
    """Solution for n set-valued laws at rest.

    Attributes
    ----------
    share : array, shape (n,)
        Forces over their limits.
    sense : array, shape (n,)
        Sense in which a speed leaves rest, 1 or -1, or 0 where it rests.
    sticks : array of bool, shape (n,)
        An independent subset of the speeds that rest: the others rest with them.
    """

    share: np.ndarray
    sense: np.ndarray
    sticks: np.ndarray


def shares(A: np.ndarray, b: np.ndarray, reached: np.ndarray) -> Shares:
    """Solve for shares u with |u| <= 1: a = b - A u is 0 where |u| < 1, and has the sign of u elsewhere.

    The accelerations a are unique. Redundant forces have the least norm of u_k sqrt(A_kk), which has no unit.

    Parameters
    ----------
    A : array, shape (n, n)
        Response of the accelerations to the shares, positive semi-definite with a positive diagonal.
    b : array, shape (n,)
        Accelerations without the forces.
    reached : array, shape (n,)
        1 or -1 for forces that have reached a limit, else 0. They stay there if the others can hold their speeds, so that
        under a growing load each of them reaches its limit once.
    """
    bound = np.sqrt(np.diag(A))
    B, c = A / np.outer(bound, bound), b / bound
    v = _bounded(B + LAWS.regular * np.eye(len(b)), c, bound)
    state = np.where(np.abs(v) >= (1 - LAWS.limit) * bound, np.sign(v), 0.0)
    free = np.flatnonzero(state == 0)
    at_limit = np.flatnonzero(state)
    v[at_limit] = state[at_limit] * bound[at_limit]
    fixed = free[reached[free] != 0]
    others = np.setdiff1d(free, fixed)
    for kept, some in ((fixed, others), (fixed[:0], free)):
        tried = v.copy()
        tried[kept] = reached[kept] * bound[kept]
        if _settled(B, c, bound, tried, free, some):
            v, free = tried, some
            state[kept] = reached[kept]  # one whose speed does not depend on those held leaves rest
            break
    sticks = np.zeros(len(b), dtype=bool)
    sticks[_independent(B, free)] = True
    rests = _dependent(B, sticks) | sticks
    return Shares(v / bound, np.where(rests, 0.0, state), sticks)


def _bounded(B: np.ndarray, c: np.ndarray, bound: np.ndarray) -> np.ndarray:
    """Minimise v' B v / 2 - c' v for |v| <= bound with positive definite B, by an active-set method (Stark and Parker 1995)."""
    from scipy.optimize import lsq_linear

    root = np.linalg.cholesky(B)
    right = scipy.linalg.solve_triangular(root, c, lower=True)
    return lsq_linear(
        root.T, right, (-bound, bound), method="bvls", tol=LAWS.regular**2, max_iter=LAWS.rounds * len(c)
    ).x


def _settled(
    B: np.ndarray, c: np.ndarray, bound: np.ndarray, v: np.ndarray, rest: np.ndarray, some: np.ndarray
) -> bool:
    """True if the forces `some`, set in place to those of least norm that hold the speeds `rest`, are within their bounds."""
    given = np.setdiff1d(np.arange(len(v)), some)
    right = c[rest] - B[np.ix_(rest, given)] @ v[given]
    v[some] = np.linalg.lstsq(B[np.ix_(rest, some)], right, rcond=LAWS.independent)[0]
    left = np.abs(right - B[np.ix_(rest, some)] @ v[some])
    size = np.abs(c[rest]) + np.abs(B[rest]) @ np.abs(v)
    return bool(np.all(left <= LAWS.independent * size) and np.all(np.abs(v[some]) <= bound[some]))


def _independent(B: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Select an independent subset of some speeds."""
    if not some.size:
        return some
    factors, order = scipy.linalg.qr(B[np.ix_(some, some)], mode="r", pivoting=True)
    pivots = np.abs(np.diag(factors))
    return some[order[pivots > LAWS.independent * pivots[0]]]


def _dependent(B: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Mark the speeds that depend on those that are held: their Schur complements are 0."""
    own = B[np.ix_(held, held)]
    left = 1 - np.sum(B[:, held].T * np.linalg.solve(own, B[held]), axis=0) if held.any() else np.ones(len(B))
    return left <= LAWS.independent
