"""Where a motion comes to rest: its steps grow, and lose energy."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import scipy

from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.initialization.reduced_linearization import Linearized, Linearizer, moved
from acausal.solve.point import Point

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
    fastest = _fastest(here) or 1.0
    h = REST.first / fastest
    for _ in range(REST.relaxation):
        there, change = _euler(own, here, h, far, bent)
        h *= change
        if there is None:
            if h * fastest < REST.shortest:
                break
            continue
        step, here = there.point.x - here.point.x, there
        if h * fastest > REST.last or np.all(np.abs(step) < REST.converged * (own.scale + np.abs(here.point.x))):
            break
    return here.point


def _fastest(here: Linearized) -> float:
    """Largest eigenvalue in 1/s; its size is enough."""
    n = here.nx
    if n > POLICY.ranks.small:
        options = {"which": "LM", "return_eigenvectors": False, "v0": np.cos(np.arange(n)), "tol": POLICY.loops.angles}
        with suppress(RuntimeError):  # it does not converge
            operator = scipy.sparse.linalg.LinearOperator((n, n), matvec=here.times, dtype=float)
            return float(np.max(np.abs(scipy.sparse.linalg.eigs(operator, 2, **options))))
    return float(np.max(np.abs(np.linalg.eigvals(here.A)), initial=0.0))


def _euler(own: Linearizer, here: Linearized, h: float, far: float, bent: float) -> tuple[Linearized | None, float]:
    """Take a step of length h, and tell by how much the next one may be longer.

    None where it cannot be taken, leads too far, or a second iteration would change it much. Both measures grow as h does.
    """
    moves, shorter = np.isin(np.arange(own.nx), own.rows), 1 / REST.shrinkage  # meters stay
    try:
        solve = here.implicit(h)
    except RuntimeError:
        return None, shorter
    step, follows = solve(own.unturned(np.where(moves, h * here.rates, 0.0)))
    step = own.unturned(step)
    if not np.all(np.isfinite(step)) or own.far(step) > far:
        return None, shorter
    try:
        there = own.linearized(own.closed(moved(here.point, step, follows)))
    except InitializationError:
        return None, shorter
    left = own.unturned(np.where(moves, h * there.rates - (there.point.x - here.point.x), 0.0))
    size, change = own.size(step), own.size(solve(left)[0])
    if not change <= bent * size:
        return None, shorter
    room = min(bent * size / change if change else np.inf, far / own.far(step) if own.far(step) else np.inf)
    return there, min(max(REST.safety * room, 1.0), REST.growth)
