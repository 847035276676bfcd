"""Forces between -1 and 1 that keep speeds at rest as far as they can: a linear complementarity problem with bounds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from acausal.policy import POLICY

LAWS = POLICY.laws


@dataclass(frozen=True, eq=False)
class Shares:
    """Solution of n laws at rest.

    Attributes
    ----------
    share : array, shape (n,)
        Forces over their limits.
    sense : array, shape (n,)
        1 or -1 where a speed leaves rest in that sense, else 0.
    sticks : array of bool, shape (n,)
        Laws that hold the speeds at rest, as many as there are independent speeds among them; the forces of the others at
        rest are given by their shares.
    """

    share: np.ndarray
    sense: np.ndarray
    sticks: np.ndarray


def shares(A: np.ndarray, b: np.ndarray, reached: np.ndarray) -> Shares:
    """Solve for u: |u| <= 1, and with a = b - A u, a_k = 0 where |u_k| < 1, else a_k u_k >= 0.

    The accelerations a are unique, and so are the forces of independent speeds; redundant ones have the least norm of A^1/2 u.

    Parameters
    ----------
    A : array, shape (n, n)
        Positive semi-definite, no entry of its diagonal 0: what each force takes off each acceleration.
    b : array, shape (n,)
        Accelerations without the forces.
    reached : array, shape (n,)
        1 or -1 for forces that have reached a limit, else 0: they stay there where others can hold their speeds, so that a growing
        load finds each of them once.
    """
    bound = np.sqrt(np.diag(A))
    B, c = A / np.outer(bound, bound), b / bound
    v, state = _pivoted(B + LAWS.regular * np.eye(len(b)), c, bound)
    state[np.abs(v) >= (1 - LAWS.limit) * bound] = np.sign(v[np.abs(v) >= (1 - LAWS.limit) * bound])
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
            break
    sticks = np.zeros(len(b), dtype=bool)
    sticks[_independent(B, free)] = True
    rests = _dependent(B, sticks) | sticks
    return Shares(v / bound, np.where(rests, 0.0, state), sticks)


def _pivoted(B: np.ndarray, c: np.ndarray, bound: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Solve for |v| <= bound by principal pivots, one at a time, the first that is wrong (Murty 1974); B is definite."""
    state, v = np.zeros(len(c)), np.zeros(len(c))
    for _ in range(LAWS.pivots * len(c)):
        free = state == 0
        v = state * bound
        v[free] = np.linalg.solve(B[np.ix_(free, free)], c[free] - B[np.ix_(free, ~free)] @ v[~free])
        a = c - B @ v
        wrong = np.flatnonzero(np.where(free, np.abs(v) > bound, state * a < 0))
        if not wrong.size:
            break
        k = wrong[0]
        state[k] = 0.0 if state[k] else np.sign(v[k])
    return np.clip(v, -bound, bound), state


def _settled(
    B: np.ndarray, c: np.ndarray, bound: np.ndarray, v: np.ndarray, rest: np.ndarray, some: np.ndarray
) -> bool:
    """Choose some of the forces in place, of least norm, so that the speeds `rest` rest; whether their limits allow that."""
    given = np.setdiff1d(np.arange(len(v)), some)
    right = c[rest] - B[np.ix_(rest, given)] @ v[given]
    v[some] = np.linalg.lstsq(B[np.ix_(rest, some)], right, rcond=LAWS.independent)[0]
    left = np.abs(right - B[np.ix_(rest, some)] @ v[some])
    size = np.abs(c[rest]) + np.abs(B[rest]) @ np.abs(v)
    return bool(np.all(left <= LAWS.independent * size) and np.all(np.abs(v[some]) <= bound[some]))


def _independent(B: np.ndarray, some: np.ndarray) -> np.ndarray:
    """As many of some speeds as are independent."""
    if not some.size:
        return some
    factors, order = scipy.linalg.qr(B[np.ix_(some, some)], mode="r", pivoting=True)
    pivots = np.abs(np.diag(factors))
    return some[order[pivots > LAWS.independent * pivots[0]]]


def _dependent(B: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Which speeds rest where those that are held do: nothing is left of their own responses."""
    own = B[np.ix_(held, held)]
    left = 1 - np.sum(B[:, held].T * np.linalg.solve(own, B[held]), axis=0) if held.any() else np.ones(len(B))
    return left <= LAWS.independent
