"""The one-step method: L-stable, of order 5; on the core, or CasADi's where that is missing.

Where it damps, it sees rates only as far as they change coordinates: their size in the error test is that of the
coordinate times the fastest eigenvalue that oscillates. Vibrations too small to be seen in the coordinates are then
damped instead of followed. The largest error of any state counts there: so few of them move that a mean hides it.
"""

from __future__ import annotations

import numpy as np

from acausal.core import Equations, Multistep
from acausal.policy import POLICY
from acausal.solve.integrate.ladder import Way
from acausal.solve.integrate.settings import Settings
from acausal.solve.problem import Problem

CALLS = POLICY.calls


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


def are_rates(problem: Problem) -> np.ndarray:
    """Return which states are rates of others, as the core takes them, shape (nx,)."""
    found = np.zeros(problem.nx, dtype=np.int32)
    found[[rate for _, rate in problem.rates]] = 1
    return found


def multistep_settings(problem: Problem, settings: Settings, way: Way, floor: np.ndarray) -> Multistep:
    """Return the settings of IDAS; algebraic unknowns do not count in its error test.

    Errors of a loose Newton iteration excite lightly damped vibrations, which then cost steps; near a singular configuration of
    a loop they are enlarged.

    Parameters
    ----------
    problem : Problem
        The model.
    settings : Settings
        How the run is to be integrated.
    way : Way
        How this leg is.
    floor : array
        Errors that rounding causes, see `rounding`.
    """
    newton = CALLS.newton_in_loops if problem.compiled.constraints.size else CALLS.newton
    return Multistep(np.maximum(settings.nominal, floor / way.tolerance), settings.order(way), newton)


def at_once(equations: Equations) -> int:
    """Return how many steps of the core take some hundredths of a second, for which an interrupt may wait."""
    return max(1, CALLS.at_once // (equations.values.size + equations.slopes.size))
