"""Order limit by trial: where eigenvalues leave it open, trials of both on the first part of a chunk decide.

Whether fast oscillations matter depends on how much they are excited. At rest, an order limit of 2 is the best; where the
motion needs many steps all the same, high orders may take fewer, as long as these are short enough to be stable.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Kind, Refusal, Way
from acausal.solve.integrate.methods import METHODS
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point

ORDER = POLICY.order


def is_open(integrator: Integrator, times: np.ndarray) -> bool:
    """Whether the highest order may take fewer steps than are allowed, although it is stable in short ones only.

    Vibrations that may be damped do not matter: where they need many steps, the one-step method takes over.
    """
    settings = integrator.settings
    if not METHODS[integrator.way.method].multistep or not settings.order_is_open or settings.may_ring(times):
        return False
    return _stable(integrator, times) < settings.patience(integrator.way, times)


def _stable(integrator: Integrator, times: np.ndarray) -> float:
    """Steps for an output interval with which the highest order is stable."""
    return integrator.settings.spectrum.fastest * float(np.max(np.diff(times), initial=0.0)) / ORDER.stable


def _patience(integrator: Integrator, times: np.ndarray) -> int:
    """Steps for an output interval after which the present order is given up."""
    most = integrator.settings.patience(integrator.way, times)
    dear = int(ORDER.dear * _stable(integrator, times))
    return most if integrator.order == ORDER.highest else min(most, max(ORDER.fewest, dear))


def doubt(integrator: Integrator, times: np.ndarray) -> int:
    """Return the steps for an output interval after which the order limit is in doubt."""
    cheap = int(ORDER.cheap * _stable(integrator, times))
    return min(_patience(integrator, times), max(ORDER.fewest, cheap, ORDER.doubt // (len(times) - 1)))


def settle(integrator: Integrator, at: Point, times: np.ndarray) -> tuple[Point, np.ndarray]:
    """Integrate as far as neither doubt nor refusal stops it; return the last point, and the times from there on.

    Parameters
    ----------
    integrator : Integrator
        Its way takes the order limit that was found.
    at : Point
        Where to begin.
    times : array
        Time of that point and output times, in s.
    """
    if not is_open(integrator, times):
        return at, times
    size = len(times) - 1
    head, chunk = max(1, size // ORDER.heads), max(1, size // ORDER.chunks)
    for wait in (head, 0):
        if len(times) == 1:
            return at, times
        way = replace(integrator.way, max_steps=doubt(integrator, times))
        found = integrator.attempt(at, times, way, keep=True)
        at, times = _kept(integrator, at, times, found.reached if isinstance(found, Refusal) else found)
        if isinstance(found, Leg) or found.kind is not Kind.STEPS:
            return at, times
        # What rings at a start may be damped soon.
        at, times = _through(
            integrator, at, times, wait, integrator.settings.patience(integrator.way, times[: head + 1])
        )
    while len(times) > 1:
        found = choose(integrator, at, times[: head + 1])
        at, times = _kept(integrator, at, times, found)
        if (left := len(times)) > 1:
            at, times = _through(integrator, at, times, chunk, _patience(integrator, times[: chunk + 1]))
            if left == len(times):
                break
    return at, times


def choose(integrator: Integrator, at: Point, times: np.ndarray) -> Leg | None:
    """Integrate a short way with both order limits, and take the one with fewer evaluations of the equations from here on.

    The highest order must win by far: a limit of 2 damps what it does not follow, and what is costly at first becomes cheap.

    Returns
    -------
    Leg or None
        What was integrated on the way, if the limit stays.
    """
    low, high = integrator.settings.max_order, ORDER.highest
    before = replace(integrator.way, order=integrator.order)
    patience = _patience(integrator, times)
    found, work = _tried(integrator, at, times, replace(before, max_steps=patience))
    gain = ORDER.gain if before.order == low else 1
    most = integrator.settings.patience(before, times) * (len(times) - 1)
    steps = most if isinstance(found, Refusal) else max(1, found.steps // gain)
    other = replace(before, order=high if before.order == low else low, max_steps=steps)
    rival, less = _tried(integrator, at, times[[0, -1]], other)
    if isinstance(rival, Refusal) or (isinstance(found, Leg) and gain * less >= work):
        return found if isinstance(found, Leg) else None
    integrator.way = replace(integrator.way, order=other.order)
    than = f"{work}" if isinstance(found, Leg) else f"more than {patience} steps for an output"
    integrator.trace.orders.append(
        f"{other.order} from t = {at.time:.6g} s on: a trial took {less} evaluations, where order {before.order} took {than}"
    )
    return None


def _through(integrator: Integrator, at: Point, times: np.ndarray, size: int, most: int) -> tuple[Point, np.ndarray]:
    """Integrate through the next output times, as far as no refusal stops it; at most so many steps for each."""
    part = times[: size + 1]
    if not size:
        return at, times
    found = integrator.attempt(at, part, replace(integrator.way, max_steps=most), keep=True)
    return _kept(integrator, at, times, found.reached if isinstance(found, Refusal) else found)


def _tried(integrator: Integrator, at: Point, times: np.ndarray, way: Way) -> tuple[Leg | Refusal, int]:
    before = integrator.trace.residual_evaluations
    found = integrator.attempt(at, times, way)
    return found, integrator.trace.residual_evaluations - before


def _kept(integrator: Integrator, at: Point, times: np.ndarray, leg: Leg | None) -> tuple[Point, np.ndarray]:
    if leg is None:
        return at, times
    integrator.trace.add(leg)
    integrator.report(float(leg.times[-1]))
    return leg.end(at), times[len(leg.times) :]
