"""Whether points that act on each other along their line meet in a run, where the line has no direction.

Between two rows they can only meet if they are as near as they may move until the next. Such an interval is integrated
again in parts, and so are its parts, until the points are too far apart for the time that is left, or meet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from acausal.policy import POLICY
from acausal.solve.checks.validity import separations
from acausal.solve.integrate.attempt import Integrator
from acausal.solve.integrate.ladder import Refusal
from acausal.solve.integrate.trace import Trace
from acausal.solve.looks import pace
from acausal.solve.problem import Point

MEETING = POLICY.meeting


@dataclass(frozen=True)
class Meeting:
    """When points met, and the message."""

    time: float
    text: str


@dataclass(frozen=True)
class _Pair:
    """Rows of a run; and of one pair of points in them, the offset, its length, rate and effect."""

    times: np.ndarray
    x: np.ndarray
    z: np.ndarray
    constants: np.ndarray
    rate: np.ndarray
    effect: np.ndarray
    offset: np.ndarray
    distance: np.ndarray

    def suspects(self) -> np.ndarray:
        """Intervals in which the points could meet."""
        return np.flatnonzero(MEETING.reach * pace(self.times, self.rate) >= self.distance[1:] + self.distance[:-1])


class _Search:
    """Search for meetings of one pair of points; `columns` are those of its values."""

    def __init__(self, integrator: Integrator, columns: slice) -> None:
        self.integrator, self.columns = integrator, columns
        self.watch = separations(integrator.compiled)
        self.looks, self.near = 0, 0.0
        self.shortest = MEETING.shortest * max(abs(t) for t in integrator.span)

    def rows(self, t: np.ndarray, x: np.ndarray, z: np.ndarray, constants: np.ndarray) -> _Pair:
        """Evaluate the pair in rows of a run."""
        values = self.watch.function(x, z, self.integrator.problem.p, t, constants)[:, self.columns]
        offset = values[:, 2:]
        return _Pair(t, x, z, constants, values[:, 0], values[:, 1], offset, np.linalg.norm(offset, axis=1))

    def run(self, rows: _Pair, everywhere: bool) -> Iterator[tuple[float, float]]:
        """Yield times of meetings in the rows of the run and effects there, in order."""
        for k in range(len(rows.times) - 1) if everywhere else rows.suspects():
            found = list(self._between(rows, k))
            passed = rows.offset[k] @ rows.offset[k + 1] < 0
            if not found and passed and (later := self._inside(rows, k, 2.0)):
                # Integrated again, they may come a little later than in the run.
                found = list(self._meetings(later))[:1]
            # Those that touch and part again on the same side did not turn the force over.
            touched = len(found) == 1 and not passed and rows.distance[k + 1] > self.near
            for time, effect in found if not touched else []:
                yield min(time, float(rows.times[k + 1])), effect

    def _meetings(self, rows: _Pair) -> Iterator[tuple[float, float]]:
        for k in rows.suspects():
            yield from self._between(rows, k)

    def _between(self, rows: _Pair, k: int) -> Iterator[tuple[float, float]]:
        """Meetings between two rows."""
        short = rows.times[k + 1] - rows.times[k] <= self.shortest
        if short or rows.distance[k] + rows.distance[k + 1] <= self.near:
            rate, effect = rows.rate[k : k + 2], rows.effect[k : k + 2]
            if rate[0] <= 0 <= rate[1]:
                yield float(rows.times[k]), float(np.mean(effect[rate == 0] if np.any(rate == 0) else effect))
        elif self.looks < MEETING.looks and (inner := self._inside(rows, k, 1.0)):
            yield from self._meetings(inner)

    def _inside(self, rows: _Pair, k: int, length: float) -> _Pair | None:
        """Rows from a row on, `length` times the interval after it; None where they cannot be reached."""
        self.looks += 1
        run, x, z = self.integrator, rows.x[k], rows.z[k]
        at = Point(float(rows.times[k]), x, z, run.compiled.layout.constants(rows.constants[k + 1]))
        times = rows.times[k] + length * (rows.times[k + 1] - rows.times[k]) * np.linspace(0, 1, MEETING.parts + 1)
        found = run.trial(at, times, MEETING.steps)
        if isinstance(found, Refusal):
            return None
        vectors = np.tile(found.constants.vector, (MEETING.parts + 1, 1))
        return self.rows(times, np.vstack([x[None], found.x]), np.vstack([z[None], found.z]), vectors)


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
    kept, integrator.trace = integrator.trace, Trace()
    found, column = [], 0
    try:
        for separation, origin in stated:
            columns = slice(column, column := column + 2 + separation.offset.sx.numel())
            found += _search(
                _Search(integrator, columns), first, kept, f"{origin}: at t = {{:.6g}} s {separation.text}"
            )
    finally:
        integrator.trace = kept
    return min(found, key=lambda meeting: meeting.time, default=None)


def _search(search: _Search, first: Point, trace: Trace, text: str) -> list[Meeting]:
    t, x, z, _, constants = trace.rows(first)
    rows = search.rows(t, x, z, constants)
    search.near = MEETING.near * float(np.max(rows.distance))
    least, n = MEETING.nothing * float(np.max(np.abs(rows.effect))), len(rows.times)
    everywhere = n <= MEETING.few and trace.steps > MEETING.steps_a_row * n
    for time, effect in islice(search.run(rows, everywhere), MEETING.harmless):
        if abs(effect) > least:
            return [Meeting(time, f"{text.format(time)} (it is {effect:.4g} there). The result up to there is kept.")]
    return []
