"""Methods of integration: the multistep method that follows everything, the one-step method that damps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from acausal.core import library
from acausal.policy import POLICY
from acausal.solve.integrate.by_casadi import by_idas, by_rosenbrock
from acausal.solve.integrate.by_core import ByCore
from acausal.solve.integrate.integration import Integration, Request
from acausal.solve.points import Point
from acausal.solve.problem import Problem

CALLS = POLICY.calls


@dataclass(frozen=True)
class Method:
    """A method of integration.

    Attributes
    ----------
    prepare : callable
        Returns the integration of a request.
    multistep : bool
        Whether its order has a limit. Such methods follow every vibration, steps of the others cost several times as much.
    """

    prepare: Callable[[Request], Integration]
    multistep: bool


def _one_step(request: Request) -> Integration:
    return ByCore(request) if library() else by_rosenbrock(request)


# In the order in which they are taken: each leaves less to follow, or less to solve, than the one before it.
METHODS = {"idas": Method(by_idas, multistep=True), "rosenbrock": Method(_one_step, multistep=False)}


def chosen(method: str) -> tuple[str, ...]:
    """Return the methods that a run may take, the first one first, by the name that `simulate` was given."""
    own = {"auto": tuple(METHODS), "resolve": tuple(name for name, m in METHODS.items() if m.multistep)}
    return own.get(method, (method,))


def rounding(problem: Problem, at: Point) -> np.ndarray:
    """Errors of states (0) and algebraic unknowns that rounding of the equations causes, as powers of ten.

    A Newton iteration cannot get nearer than |g_z^-1| (|g_x| |x| + |g_z| |z|) times the relative rounding error.
    """
    nx = problem.nx
    J = np.abs(g := problem.local(at).jacobian[nx : nx + problem.nz].toarray())
    sizes = J @ np.abs(at.y)
    try:
        reach = np.abs(np.linalg.inv(g[:, nx:])) @ sizes
    except np.linalg.LinAlgError:
        reach = np.zeros(problem.nz)
    nominal = problem.nominal[nx:]
    floor = nominal * 10.0 ** np.ceil(np.log10(np.maximum(CALLS.rounding * reach / nominal, np.finfo(float).tiny)))
    return np.concatenate([np.zeros(nx), np.where(np.isfinite(floor), floor, 0.0)])
