"""Shares of friction forces at rest, computed by the core."""

from __future__ import annotations

from ctypes import c_int32, c_void_p
from dataclasses import dataclass

import numpy as np

from acausal.core.library import address, loaded


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
    given = [np.ascontiguousarray(a, dtype=float) for a in (A, b, reached)]
    share, sense, sticks = found = [np.empty(len(b)) for _ in range(3)]
    solve = loaded().ac_shares
    solve.argtypes = (c_int32, *[c_void_p] * 6)
    if solve(len(b), *map(address, (*given, *found))):
        raise MemoryError
    return Shares(share, sense, sticks > 0)
