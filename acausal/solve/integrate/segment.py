"""One smooth segment of a run: in one call, in chunks where that fails, at last from output to output."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Refusal, Way, accepted, next_ways
from acausal.solve.integrate.order_trial import settle
from acausal.solve.integrate.trace import Leg
from acausal.solve.points import Point

RESCUE = POLICY.rescue


def segment(integrator: Integrator, at: Point, times: np.ndarray) -> Point:
    """Integrate from times[0] through all other times, without a break between them; return the last point.

    Raises
    ------
    Failure
        If the integrator gives up; the trace holds what was reached.
    """
    at, times = settle(integrator, at, times)
    if len(times) == 1:
        return at
    found = quickly(integrator, at, times)
    if isinstance(found, Leg):
        integrator.trace.add(found)
        return found.end(at)
    n = len(times) - 1
    integrator.way = replace(integrator.way, method=integrator.settings.methods[0])
    size = max(1, -(-n // RESCUE.chunks))
    for first in range(0, n, size):
        part = times[first : first + size + 1]
        way = replace(integrator.way, careful=True, max_steps=RESCUE.hopeless // (len(part) - 1))
        found = integrator.attempt(at, part, way)
        if isinstance(found, Leg):
            integrator.trace.add(found)
            at = found.end(at)
        else:
            at = _creep(integrator, at, part, n)
        integrator.report(part[-1])
    return at


def quickly(integrator: Integrator, at: Point, times: np.ndarray) -> Leg | Refusal:
    """Integrate through all times in one call, in the way of now or in those that come next; the last one stays."""
    rescues = integrator.settings.rescues(times, integrator.loops)
    while True:
        way = replace(integrator.way, max_steps=integrator.settings.patience(integrator.way, times))
        found = integrator.attempt(at, times, way)
        following = next_ways(way, found, rescues) if isinstance(found, Refusal) else ()
        if not following:
            return found
        integrator.way = following[0]


def _creep(integrator: Integrator, at: Point, times: np.ndarray, outputs: int) -> Point:
    """Go from output to output, until the failure if there is one; return the last point."""
    for k in range(len(times) - 1):
        found = accepted(passage(integrator, at, times[k : k + 2], outputs))
        integrator.trace.add(found)
        at = found.end(at)
    return at


def passage(integrator: Integrator, at: Point, times: np.ndarray, outputs: int) -> Leg | Refusal:
    """Integrate one interval where a call over many failed, by every means.

    That is new choices of states on the way, the other method, and a larger tolerance.

    Parameters
    ----------
    integrator : Integrator
        Integrates the run.
    at : Point
        Where it begins.
    times : array, shape (2,)
        Its ends in s.
    outputs : int
        Number of outputs that share the steps.
    """
    # Loops that get stuck beside a singular position do so for ever.
    most = RESCUE.long if integrator.loops else RESCUE.hopeless // min(outputs, RESCUE.hopeless // RESCUE.long)
    way = replace(integrator.way, careful=True, max_steps=most)
    found = _stride(integrator, at, times, way, RESCUE.halvings)
    if isinstance(found, Leg):
        return found
    for loose in next_ways(way, found, integrator.settings.rescues(times, integrator.loops)):
        leg = integrator.attempt(at, times, loose)
        if isinstance(leg, Leg):
            integrator.trace.loosened += [float(times[0])] * (loose.tolerance > way.tolerance)
            return leg
    return found


def _stride(integrator: Integrator, at: Point, times: np.ndarray, way: Way, halvings: int) -> Leg | Refusal:
    """Go to the next output, with new choices of states on the way where one does not last."""
    found = integrator.attempt(at, times, way)
    if isinstance(found, Leg) or not halvings or not integrator.settings.rescues(times, integrator.loops).wears(found):
        return found
    middle = (times[0] + times[1]) / 2
    first = _stride(integrator, at, np.array([times[0], middle]), way, halvings - 1)
    if isinstance(first, Refusal):
        return first
    last = _stride(integrator, first.end(at), np.array([middle, times[1]]), way, halvings - 1)
    return last if isinstance(last, Refusal) else replace(last, energy=last.energy + first.energy[-1])
