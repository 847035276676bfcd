"""Where a motion comes to rest: its steps grow, and lose energy."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
import scipy

from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.points import Point
from acausal.solve.start.linearized import Linearized, Linearizer, moved

REST = POLICY.rest


def relax(own: Linearizer, at: Point, far: float, bent: float) -> Point:
    """Return where the motion leads by steps of the linearly implicit Euler method that grow.

    Parameters
    ----------
    own : Linearizer
        Linearises near the guess.
    at : Point
        Where it begins.
    far : float
        How far a step may lead, in nominal values of coordinates.
    bent : float
        What a second iteration may change in a step, over it.
    """
    try:
        here = own.linearized(own.closed(at))
    except InitializationError:
        return at
    fastest = float(np.max(np.abs(np.linalg.eigvals(here.A)), initial=0.0)) or 1.0
    h = REST.first / fastest
    for _ in range(REST.relaxation):
        there = _euler(own, here, h, far, bent)
        if there is None:
            h /= REST.shrinkage
            if h * fastest < REST.shortest:
                break
            continue
        step, here = there.point.x - here.point.x, there
        h *= REST.growth
        if h * fastest > REST.last or np.all(np.abs(step) < REST.converged * (own.scale + np.abs(here.point.x))):
            break
    return here.point


def _euler(own: Linearizer, here: Linearized, h: float, far: float, bent: float) -> Linearized | None:
    """Take a step of length h; None where it cannot be taken, leads too far, or a second iteration would change it much."""
    moves = np.isin(np.arange(own.nx), own.rows)  # meters stay
    solve = _solver(np.eye(own.nx) - h * here.A)
    step = own.unturned(solve(own.unturned(np.where(moves, h * here.rates, 0.0))))
    if not np.all(np.isfinite(step)) or own.far(step) > far:
        return None
    try:
        there = own.linearized(own.closed(moved(here.point, step)))
    except InitializationError:
        return None
    left = own.unturned(np.where(moves, h * there.rates - (there.point.x - here.point.x), 0.0))
    return there if own.size(solve(left)) <= bent * own.size(step) else None


def _solver(matrix: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """Solve with a matrix many times; nan where it is singular."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", scipy.linalg.LinAlgWarning)
        factors = scipy.linalg.lu_factor(matrix, check_finite=False)
    return lambda right: scipy.linalg.lu_solve(factors, right, check_finite=False)
