"""Pseudo-transient continuation: follow the motion to an equilibrium by growing implicit steps that dissipate energy."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import scipy

from acausal.errors import InitializationError
from acausal.policy import POLICY
from acausal.solve.initialization.reduced_linearization import Linearizer, ReducedLinearization, moved
from acausal.solve.point import Point

REST = POLICY.rest


def relax(own: Linearizer, at: Point, far: float, bent: float) -> Point:
    """Return the end of the motion by growing steps of the linearly implicit Euler method.

    Parameters
    ----------
    own : Linearizer
        Linearises near the guess.
    at : Point
        Where it begins.
    far : float
        Largest step, in nominal values of coordinates.
    bent : float
        Largest change of a step by a second Newton iteration, relative to the step.
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


def _fastest(here: ReducedLinearization) -> float:
    """Spectral radius in 1/s."""
    n = here.nx
    if n > POLICY.ranks.small:
        options = {"which": "LM", "return_eigenvectors": False, "v0": np.cos(np.arange(n)), "tol": POLICY.loops.angles}
        with suppress(RuntimeError):  # no convergence
            operator = scipy.sparse.linalg.LinearOperator((n, n), matvec=here.times, dtype=float)
            return float(np.max(np.abs(scipy.sparse.linalg.eigs(operator, 2, **options))))
    return float(np.max(np.abs(np.linalg.eigvals(here.A)), initial=0.0))


def _euler(
    own: Linearizer, here: ReducedLinearization, h: float, far: float, bent: float
) -> tuple[ReducedLinearization | None, float]:
    """Take a step of length h; return the factor of the next step size as well.

    None if the step fails, leads too far, or a second iteration would change it much. Both measures are proportional to h.
    """
    moves, shorter = np.isin(np.arange(own.nx), own.rows), 1 / REST.shrinkage  # counters stay
    try:
        solve = here.implicit(h)
    except RuntimeError:
        return None, shorter
    step, follows = solve(own.without_rotation(np.where(moves, h * here.rates, 0.0)))
    step = own.without_rotation(step)
    if not np.all(np.isfinite(step)) or own.far(step) > far:
        return None, shorter
    try:
        there = own.linearized(own.closed(moved(here.point, step, follows)))
    except InitializationError:
        return None, shorter
    left = own.without_rotation(np.where(moves, h * there.rates - (there.point.x - here.point.x), 0.0))
    size, change = own.size(step), own.size(solve(left)[0])
    if not change <= bent * size:
        return None, shorter
    room = min(bent * size / change if change else np.inf, far / own.far(step) if own.far(step) else np.inf)
    return there, min(max(REST.safety * room, 1.0), REST.growth)
