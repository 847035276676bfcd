"""The directions that the constraints leave free, in terms of as many states."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.solve.rank import null_space, pivots


def tangent(
    compiled: CompiledModel, x: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Choose independent states, and say how all states follow from small changes of them.

    Returns
    -------
    N : array, shape (nx, n)
        Changes of all states for a unit change of each independent one; all constraints hold along them.
    chosen : array of int, shape (n,)
        The independent states, those along which the motion is largest.
    """
    nx = compiled.nx
    if not compiled.closing.size:
        return np.eye(nx), np.arange(nx)
    J = compiled.closing(x, p, t, modes)[1]
    null = null_space(J)
    # Whatever no constraint holds stays a state of its own, before all others.
    weight = np.where(np.any(J != 0, axis=0), 1.0, 10.0)
    chosen = np.sort(pivots(null * weight)[: len(null)])
    return np.linalg.solve(null[:, chosen], null).T, chosen
