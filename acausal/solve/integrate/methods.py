"""Methods of integration: the multistep method, and the one-step method that follows vibrations or damps them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from acausal.core import Multistep, why_no_idas, why_not
from acausal.core.sundials import REMEDY
from acausal.errors import DeclarationError
from acausal.policy import POLICY
from acausal.solve.integrate.ladder import Way
from acausal.solve.integrate.settings import Settings
from acausal.solve.point import Point
from acausal.solve.problem import Problem

CALLS = POLICY.calls


@dataclass(frozen=True)
class Method:
    """A method of integration.

    Attributes
    ----------
    name : str
        What it is called in `simulate` and in results.
    multistep : bool
        Whether its order has a limit. Steps of the others cost several times as much.
    damps : bool
        Whether it leaves vibrations out that coordinates do not show, in place of following them.
    """

    name: str
    multistep: bool = False
    damps: bool = False


# In the order in which they are taken: the next one solves with a Newton iteration, the last one leaves less to follow.
METHODS = {
    "following": Method("rosenbrock"),
    "idas": Method("idas", multistep=True),
    "rosenbrock": Method("rosenbrock", damps=True),
}


def chosen(method: str, max_order: int | None = None) -> tuple[str, ...]:
    """Return the methods that a run may take, the first one first.

    Parameters
    ----------
    method, max_order
        As of `simulate`: a limit of the order asks for the multistep method.

    Raises
    ------
    DeclarationError
        If the core is missing, or IDAS is asked for and cannot be loaded.
    """
    if missing := why_not():
        raise DeclarationError(f"the core cannot be used: {missing}.")
    why = why_no_idas()
    if method == "auto" and max_order is None:
        return tuple(name for name in METHODS if not why or name != "idas")
    if why and method != "rosenbrock":
        raise DeclarationError(f"IDAS cannot be used: {why}; {REMEDY}.")
    return {"auto": ("idas", "rosenbrock"), "resolve": ("idas",)}.get(method, (method,))


def why_first(method: str, max_order: int | None) -> str:
    """Say why the first of the methods is taken first."""
    if method != "auto":
        return "given"
    if max_order is not None:
        return "idas, whose order has a limit, as one is given"
    return "rosenbrock takes less time at equal error"


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
    loops = problem.compiled.constraints.size
    newton = CALLS.newton_in_loops if loops else CALLS.newton
    tolerance = way.tolerance
    if loops and tolerance == settings.tolerance and not settings.vibrates(settings.span / settings.outputs):
        tolerance = max(CALLS.stricter_in_loops * tolerance, min(tolerance, CALLS.strictest))
    return Multistep(np.maximum(settings.nominal, floor / tolerance), tolerance, settings.order(way), newton)


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
