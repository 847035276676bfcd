"""Whether points that act on each other along their line meet in a run, where the line has no direction.

Between two rows they can only meet if they are as near as they may move until the next. Such an interval is integrated
again in parts, and so are its parts, until the points are too far apart for the time that is left, or meet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from acausal.policy import POLICY
from acausal.solve.checks.validity import separations
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Refusal
from acausal.solve.looks import pace
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem

MEETING = POLICY.meeting


@dataclass(frozen=True)
class Meeting:
    """When points met, and the message."""

    time: float
    text: str


@dataclass(frozen=True)
class _Approach:
    """One pair of points in some rows: offset, its length, rate and effect."""

    rows: Rows
    rate: np.ndarray
    effect: np.ndarray
    offset: np.ndarray
    distance: np.ndarray

    def suspects(self) -> np.ndarray:
        """Intervals in which the points could meet."""
        return np.flatnonzero(
            MEETING.reach * pace(self.rows.times, self.rate) >= self.distance[1:] + self.distance[:-1]
        )


class _Search:
    """Search for meetings of one pair of points; `columns` are those of its values."""

    def __init__(self, integrator: Integrator, columns: slice) -> None:
        self.integrator, self.columns = integrator, columns
        self.watch = separations(integrator.compiled)
        self.looks, self.near = 0, 0.0
        self.shortest = MEETING.shortest * max(abs(t) for t in integrator.span)

    def approach(self, rows: Rows) -> _Approach:
        """Evaluate the pair in rows of a run."""
        values = self.integrator.problem.each(self.watch.function, rows)[:, self.columns]
        offset = values[:, 2:]
        return _Approach(rows, values[:, 0], values[:, 1], offset, np.linalg.norm(offset, axis=1))

    def in_rows(self, seen: _Approach, everywhere: bool) -> Iterator[tuple[float, float]]:
        """Yield times of meetings in the rows of the run and effects there, in order."""
        for k in range(len(seen.rows) - 1) if everywhere else seen.suspects():
            found = list(self._between(seen, k))
            passed = seen.offset[k] @ seen.offset[k + 1] < 0
            if not found and passed and (later := self._inside(seen.rows, k, 2.0)):
                # Integrated again, they may come a little later than in the run.
                found = list(self._meetings(later))[:1]
            # Those that touch and part again on the same side did not turn the force over.
            touched = len(found) == 1 and not passed and seen.distance[k + 1] > self.near
            for time, effect in found if not touched else []:
                yield min(time, float(seen.rows.times[k + 1])), effect

    def _meetings(self, seen: _Approach) -> Iterator[tuple[float, float]]:
        for k in seen.suspects():
            yield from self._between(seen, k)

    def _between(self, seen: _Approach, k: int) -> Iterator[tuple[float, float]]:
        """Meetings between two rows."""
        times = seen.rows.times
        if times[k + 1] - times[k] <= self.shortest or seen.distance[k] + seen.distance[k + 1] <= self.near:
            rate, effect = seen.rate[k : k + 2], seen.effect[k : k + 2]
            if rate[0] <= 0 <= rate[1]:
                yield float(times[k]), float(np.mean(effect[rate == 0] if np.any(rate == 0) else effect))
        elif self.looks < MEETING.looks and (inner := self._inside(seen.rows, k, 1.0)):
            yield from self._meetings(inner)

    def _inside(self, rows: Rows, k: int, length: float) -> _Approach | None:
        """Rows from a row on, `length` times the interval after it; None where they cannot be reached."""
        self.looks += 1
        problem, times = self.integrator.problem, rows.times
        at = replace(problem.point(rows, k), constants=problem.point(rows, k + 1).constants)
        times = times[k] + length * (times[k + 1] - times[k]) * np.linspace(0, 1, MEETING.parts + 1)
        found = self.integrator.trial(at, times, MEETING.steps)
        if isinstance(found, Refusal):
            return None
        return self.approach(found.since(at))


def first_meeting(integrator: Integrator, first: Point) -> Meeting | None:
    """Return the first meeting at which something acts; None if there is none.

    Parameters
    ----------
    integrator : Integrator
        Its trace is searched, and unchanged.
    first : Point
        Where the run began.
    """
    stated = separations(integrator.compiled).stated
    if not stated or not integrator.trace.pieces:
        return None
    rows, steps = integrator.trace.rows(first), integrator.trace.steps
    aside, column, found = integrator.aside(), 0, []
    for separation, origin in stated:
        columns = slice(column, column := column + 2 + separation.offset.sx.numel())
        search = _Search(aside, columns)
        found += _search(search, rows, steps, f"{origin}: at t = {{:.6g}} s {separation.text}")
    return min(found, key=lambda meeting: meeting.time, default=None)


def meeting_ahead(problem: Problem, at: Point, time: float) -> str:
    """Say which points, seen from a point shortly before a run was given up, meet then; "" if none do.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Near the end of the run.
    time : float
        When it was given up, in s.
    """
    watch, column = separations(problem.compiled), 0
    values = problem.each(watch.function, Rows.of(at))[0] if watch.stated else np.empty(0)
    for separation, origin in watch.stated:
        rate, effect, *offset = values[column : (column := column + 2 + separation.offset.sx.numel())]
        if effect and np.linalg.norm(offset) <= MEETING.ahead * -rate * (time - at.time):
            return f"{origin}: at t = {time:.6g} s {separation.text}."
    return ""


def _search(search: _Search, rows: Rows, steps: int, text: str) -> list[Meeting]:
    seen, n = search.approach(rows), len(rows)
    search.near = MEETING.near * float(np.max(seen.distance))
    least = MEETING.nothing * float(np.max(np.abs(seen.effect)))
    everywhere = n <= MEETING.few and steps > MEETING.steps_a_row * n
    for time, effect in islice(search.in_rows(seen, everywhere), MEETING.harmless):
        if abs(effect) > least:
            return [Meeting(time, f"{text.format(time)} (it is {effect:.4g} there).")]
    return []
