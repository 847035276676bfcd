"""Figures of the hard cases against their bounds."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import quad, solve_ivp


def within(what: str, figure: float, bound: float) -> None:
    """Assert that a figure does not exceed its bound; `pytest -rP` shows it."""
    print(f"{what}: {figure:.2g} (bound {bound:.2g})")
    assert figure <= bound, what


def single_coordinate(
    inertia: Callable[[float], tuple[float, float]], times: np.ndarray, start: float, rate: float, moment: float = 0.0
) -> np.ndarray:
    """Solve J(q) q'' + J'(q) q'^2 / 2 = moment in q and p = J q'; return q at each time.

    Parameters
    ----------
    inertia : callable
        Reduced inertia J(q), and J'(q).
    times : array
        Increasing times from 0.
    start, rate : float
        q and q' at the start.
    moment : float
        Constant generalised force.
    """

    def derivative(_: float, state: np.ndarray) -> list[float]:
        q, p = state
        J, slope = inertia(q)
        return [p / J, moment + slope * (p / J) ** 2 / 2]

    momentum = inertia(start)[0] * rate
    return solve_ivp(derivative, (0.0, times[-1]), [start, momentum], "DOP853", times, rtol=1e-11, atol=1e-12).y[0]


def with_slope(inertia: Callable[[float], float]) -> Callable[[float], tuple[float, float]]:
    """Append the derivative by differences of a reduced inertia that is exact to rounding."""
    step = 1e-6
    return lambda q: (inertia(q), (inertia(q + step) - inertia(q - step)) / (2 * step))


def travel_time(inertia: Callable[[float], float], energy: float, q0: float, q1: float, points: list[float]) -> float:
    """Return the time from q0 to q1 at constant kinetic energy; `points` are where J(q) is steep."""
    inside = [q for q in points if q0 < q < q1]
    return quad(lambda q: np.sqrt(inertia(q) / (2 * energy)), q0, q1, points=inside, limit=500, epsrel=1e-10)[0]
