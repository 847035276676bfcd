"""Sizes of states in the error test of the one-step method, which is L-stable and of order 5.

Where it damps, the method sees rates only as far as they change coordinates: their size in the error test is that of the
coordinate times the fastest eigenvalue that oscillates. Vibrations too small to be seen in the coordinates are then
damped instead of followed. The largest error of any state counts there: so few of them move that a mean hides it.
"""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.solve.problem import Problem, rates_of


def sizes(problem: Problem, nominal: np.ndarray, vibration: float) -> np.ndarray:
    """Return the sizes of the states in the error test of a method that damps.

    Parameters
    ----------
    problem : Problem
        The model.
    nominal : array
        Sizes of states, and maybe others after them.
    vibration : float
        Size of the largest eigenvalue that oscillates, in 1/s.
    """
    size = nominal[: problem.nx].copy()
    for coordinate, rate in problem.rates:
        size[rate] = max(size[rate], size[coordinate] * vibration)
    return size


def are_rates(compiled: CompiledModel) -> np.ndarray:
    """Return which states are rates of others, as the core takes them, shape (nx,)."""
    found = np.zeros(compiled.nx, dtype=np.int32)
    found[[rate for _, rate in rates_of(compiled)]] = 1
    return found
