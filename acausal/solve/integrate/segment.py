"""One smooth segment of a run: in one call, in chunks where that fails, at last from output to output."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Kind, Refusal, Way, accepted, next_ways
from acausal.solve.integrate.order_trial import settle
from acausal.solve.integrate.trace import Leg
from acausal.solve.point import Point

RESCUE = POLICY.rescue


def segment(integrator: Integrator, at: Point, times: np.ndarray) -> Point:
    """Integrate from times[0] through all other times, without a break between them; return the last point.

    Raises
    ------
    Failure
        If the integrator gives up; the trace holds what was reached.
    """
    at, times = settle(integrator, at, times)
    while len(times) > 1:
        found, rest = quickly(integrator, at, times)
        if isinstance(found, Refusal):
            return _in_chunks(integrator, at, times, found)
        integrator.trace.add(found)
        at, times = found.end(at), rest
        if len(times) > 1:
            integrator.report(at.time)
    return at


def _in_chunks(integrator: Integrator, at: Point, times: np.ndarray, refusal: Refusal) -> Point:
    """Integrate with the careful method, in chunks, after a refused call through all times; return the last point."""
    n = len(times) - 1
    integrator.take(replace(integrator.way, method=integrator.settings.careful), refusal)
    size = max(1, -(-n // RESCUE.chunks))
    for first in range(0, n, size):
        part = times[first : first + size + 1]
        way = replace(integrator.way, careful=True, max_steps=RESCUE.hopeless // (len(part) - 1))
        found = _patiently(integrator, at, part, way)
        if isinstance(found, Leg):
            integrator.trace.add(found)
            at = found.end(at)
        else:
            at = _creep(integrator, at, part, n, found)
        integrator.report(part[-1])
    return at


def quickly(integrator: Integrator, at: Point, times: np.ndarray) -> tuple[Leg | Refusal, np.ndarray]:
    """Integrate in one call, in the way of now or in those that come next; the last one stays.

    Returns
    -------
    found : Leg or Refusal
        Through all times, or as far as the constraints that are kept may last.
    rest : array
        The times from its end on.
    """
    while True:
        head, rest = integrator.next_call(at, times)
        way = integrator.settings.first(integrator.way, head)
        found = integrator.attempt(at, head, way)
        if isinstance(found, Leg):
            integrator.lasted(head[-1] - head[0])
            return found, rest
        if found.kind is Kind.UNFIT:
            integrator.reach.ended(found.time - at.time)
            continue
        following = next_ways(way, found, integrator.settings.rescues(head, integrator.loops))
        if not following:
            return found, times
        integrator.take(following[0], found)


def _patiently(integrator: Integrator, at: Point, times: np.ndarray, way: Way) -> Leg | Refusal:
    """Integrate with as many steps as a way allows, unless twice as many came no further: where steps tend to 0."""
    reached = None
    for most in (RESCUE.patient, 2 * RESCUE.patient, way.max_steps):
        found = integrator.attempt(at, times, replace(way, max_steps=min(most, way.max_steps)))
        if isinstance(found, Leg) or found.kind is not Kind.STEPS or most >= way.max_steps:
            break
        if reached is not None and found.time - reached <= RESCUE.stalled * (times[-1] - times[0]):
            return replace(found, kind=Kind.STALLED)
        reached = found.time
    return found


def _creep(integrator: Integrator, at: Point, times: np.ndarray, outputs: int, refusal: Refusal) -> Point:
    """Go from output to output, until the failure if there is one, after a refused call; return the last point."""
    for k in range(len(times) - 1):
        found = accepted(passage(integrator, at, times[k : k + 2], outputs, refusal if len(times) == 2 else None))
        integrator.trace.add(found)
        at = found.end(at)
    return at


def passage(
    integrator: Integrator, at: Point, times: np.ndarray, outputs: int, refusal: Refusal | None = None
) -> Leg | Refusal:
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
    refusal : Refusal, optional
        That of a careful call over the same interval, which need not be repeated.
    """
    # Loops that get stuck beside a singular configuration do so for ever.
    most = RESCUE.long if integrator.loops else RESCUE.hopeless // min(outputs, RESCUE.hopeless // RESCUE.long)
    way = replace(integrator.way, careful=True, max_steps=most)
    found = _stride(integrator, at, times, way, RESCUE.halvings, refusal)
    if isinstance(found, Leg):
        return found
    for loose in next_ways(way, found, integrator.settings.rescues(times, integrator.loops)):
        leg = integrator.attempt(at, times, loose)
        if isinstance(leg, Leg):
            integrator.trace.loosened += [float(times[0])] * (loose.tolerance > way.tolerance)
            return leg
        if found.kind is Kind.UNSOLVABLE and leg.kind is Kind.CORRECTOR:
            # A Newton iteration tells where the solution ended, not only that there is none at an output.
            found = min(found, leg, key=lambda refusal: refusal.time)
    return found


def _stride(
    integrator: Integrator, at: Point, times: np.ndarray, way: Way, halvings: int, refusal: Refusal | None = None
) -> Leg | Refusal:
    """Go to the next output, with new choices on the way: half-way where states do not last, where constraints become unfit."""
    gained = np.zeros(2)
    while True:
        found, refusal = refusal or _patiently(integrator, at, times, way), None
        if isinstance(found, Leg):
            return replace(found, energy=found.energy + gained)
        if not halvings or not integrator.settings.rescues(times, integrator.loops).wears(found):
            return found
        unfit = found.kind is Kind.UNFIT
        part = found.time if unfit else (times[0] + times[1]) / 2
        first = _stride(integrator, at, np.array([times[0], part]), way, halvings - 1)
        if isinstance(first, Refusal):
            return first
        at, times, gained = first.end(at), np.array([part, times[1]]), gained + first.energy[-1]
        halvings -= not unfit


def approached(run: Integrator, at: Point, time: float) -> Point:
    """Return the point nearest to a time at which a run was given up, as far as it can be reached from its last row."""
    times = at.time + (time - at.time) * (1 - RESCUE.nearer ** -np.arange(RESCUE.approaches))
    if not np.all(np.diff(times) > 0):
        return at
    aside = run.aside()
    way = replace(aside.way, method=run.settings.careful, careful=True, max_steps=RESCUE.patient)
    found = aside.attempt(at, times, way, works=False, keep=True)
    rows = found.reached if isinstance(found, Refusal) else found
    return rows.end(at) if rows else at
