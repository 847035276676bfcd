"""Message of a failed run: what the integrator could not do, in which equations, and the remedy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.flatten.origin import Origin
from acausal.policy import POLICY
from acausal.solve.checks.separation import coincidence_ahead
from acausal.solve.diagnosis.not_finite import cause, infinite_slope, undefined_equations
from acausal.solve.initialization.newton import NoConvergence, algebraic
from acausal.solve.initialization.redundancy import Redundancy, is_singular
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Failure, Kind
from acausal.solve.point import Point
from acausal.solve.problem import Problem

LISTED = 3  # states in a message
CAUSES = POLICY.causes
SINGULAR = (
    "The loops are in or near a singular configuration there, as where all links lie in line: it does not determine "
    "on which branch they continue, and forces are undefined. Start 0.01 rad away from it, give a velocity along one "
    "branch, w=fixed(...) of a joint, or try another method=."
)
REMEDIES = {
    Kind.STEPS: "The solution changes ever faster, or much faster than the outputs show: a force tends to infinity (1/r^2 "
    "at r = 0), a value grows without bound, or a part is very stiff or very light. Check the equations above, or end the "
    "run earlier, stop_time=...; if the run is only long, give more intervals=....",
    Kind.ROUNDING: "Give a larger one, for instance tolerance=1e-9.",
    None: "A value grows without bound, a force tends to infinity, or a function jumps. Check the equations above; write a "
    "jump as piecewise(...) or when(...).",
}


def failure_text(integrator: Integrator, begun: Point, left: Redundancy, failure: Failure) -> str:
    """Return the message for a run in which the integrator failed.

    Parameters
    ----------
    integrator : Integrator
        With the results so far.
    begun : Point
        Start of the run.
    left : Redundancy
        Redundant constraints and singularity of the start.
    failure : Failure
        Time and reason.
    """
    problem, pieces = integrator.problem, integrator.trace.pieces
    reached = bool(pieces)
    at = problem.point(pieces[-1].rows, -1) if reached else begun
    begins = failure.time <= begun.time
    head = f"the run {'cannot start' if begins else 'stopped'} at t = {failure.time:.6g} s:"
    if failure.kind in (None, Kind.LIMIT, Kind.DIVERGENCE):
        return f"{head} {failure.reason.removesuffix('.')}."
    if long := _too_long(problem, begun, integrator.span[1]):
        return f"{head} {failure.reason}.\n{long}"
    near = failure.at or at
    if met := coincidence_ahead(problem, near, failure.time, CAUSES.shortest * (failure.time - begun.time)):
        return met
    lines = [f"{head} {failure.reason}."]
    if is_singular(problem, at) or (left.singular and not reached):
        return "\n".join([*lines, _fastest(problem, near), SINGULAR])
    found = _cause(problem, at, failure.time, begun.time)
    if found:
        # The failure of the equations is the cause; the reason of the integrator would only repeat the symptom.
        same = f"at t = {failure.time:.6g} s "
        lines = (
            [f"{head} {found.removeprefix(same)}"] if found.startswith(same) else [*lines, found[0].upper() + found[1:]]
        )
        return "\n".join(lines)
    remedy = REMEDIES.get(failure.kind, REMEDIES[None])
    return "\n".join([*lines, *filter(None, [_fastest(problem, near)]), remedy])


def _cause(problem: Problem, at: Point, stopped: float, begun: float) -> str:
    """Return which equations fail at the last point, or slightly beyond it along the motion; "" if none does."""
    if found := undefined_equations(problem, at, remedy=LIMITS) or cause(problem, at) or infinite_slope(problem, at):
        return found
    rates = problem.values(at)[: problem.nx].copy()
    slope = np.where(np.isfinite(rates), rates, 0.0)
    way = max(stopped - at.time, CAUSES.shortest * (stopped - begun))
    for part in CAUSES.beyond:
        later = replace(at, time=at.time + part * way, x=at.x + part * way * slope)
        if found := undefined_equations(problem, later, remedy=LIMITS):
            return found
        try:
            algebraic(problem, later)
        except NoConvergence as lost:
            return f"from there on these equations have no solution:\n{lost.worst}\n{LIMITS}"
    return ""


LIMITS = "State what holds beyond, piecewise((value, condition), ..., otherwise), or end the run before, stop_time=...."


def _too_long(problem: Problem, begun: Point, stop: float) -> str:
    """Return the message that floating-point times at the end are coarser than the fastest change at the start, or ""."""
    rates, apart = _rates(problem, begun), float(np.spacing(abs(stop)))
    fastest = float(np.max(rates, where=np.isfinite(rates), initial=0.0))
    if fastest * apart <= 1:
        return ""
    return (
        f"stop_time={stop:g} is too large: floating-point times near it are {apart:.2g} s apart, but values change within "
        f"{1 / fastest:.2g} s at the start. End the run earlier, stop_time=...."
    )


def _rates(problem: Problem, at: Point) -> np.ndarray:
    """Rates of the states at a point, relative to nominal values, in 1/s."""
    return np.abs(problem.values(at)[: problem.nx] / problem.compiled.nominal[: problem.nx])


def _fastest(problem: Problem, at: Point) -> str:
    """Return the states that change fastest at a point, with the equations of their rates."""
    compiled = problem.compiled
    rates = _rates(problem, at)
    order = np.argsort(-np.nan_to_num(rates, nan=np.inf))[:LISTED]
    moving = [int(k) for k in order if rates[k] > 0 or not np.isfinite(rates[k])]
    lines = [f"  `{compiled.states[k]}` = {at.x[k]:.4g}{_where(problem, k)}" for k in moving]
    return f"Fastest changes at t = {at.time:.6g} s, the last accepted values:\n" + "\n".join(lines) if lines else ""


def _where(problem: Problem, state: int) -> str:
    """Return where the derivative of a state is stated, "" if a joint or a root defines it."""
    r = problem.compiled.reduced
    rate = r.plan.system.derivative[r.plan.states[state]]
    origins = r.flat.equations.origins
    found: list[Origin] = [
        origins[e] for v, e in (*r.plan.assigned, *r.plan.observed) if v == rate and e < len(origins)
    ]
    return f" ({found[0]})" if found and found[0].kind != "root" else ""
