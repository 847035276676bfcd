"""Separation of points with a force along their line, whose direction is undefined where they coincide.

Between two rows they can coincide only if their relative speed bridges the distance. Such an interval is integrated again in
parts, recursively, until the distance is too large for the time step, or the points coincide.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from acausal.policy import POLICY
from acausal.solve.checks.validity import separations
from acausal.solve.events.aside import integrate_aside
from acausal.solve.integrate.integrator import Integrator
from acausal.solve.integrate.ladder import Refusal
from acausal.solve.looks import pace
from acausal.solve.point import Point, Rows
from acausal.solve.problem import Problem

MEETING = POLICY.meeting


@dataclass(frozen=True)
class Violation:
    """Time at which a requirement of a component is violated, and the message."""

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
        """Intervals in which the points may coincide."""
        return np.flatnonzero(
            MEETING.reach * pace(self.rows.times, self.rate) >= self.distance[1:] + self.distance[:-1]
        )


class _Search:
    """Search for coincidences of one pair of points; `columns` are those of its values."""

    def __init__(self, integrator: Integrator, columns: slice) -> None:
        self.integrator, self.columns = integrator, columns
        self.statements = separations(integrator.compiled)
        self.samples, self.near = 0, 0.0
        self.shortest = MEETING.shortest * max(abs(t) for t in integrator.span)

    def approach(self, rows: Rows) -> _Approach:
        """Evaluate the pair in rows of a run."""
        values = self.integrator.problem.each(self.statements.function, rows)[:, self.columns]
        offset = values[:, 2:]
        return _Approach(rows, values[:, 0], values[:, 1], offset, np.linalg.norm(offset, axis=1))

    def coincidences(self, approach: _Approach, everywhere: bool) -> Iterator[tuple[float, float]]:
        """Yield times of coincidences in the rows of the run and forces there, in order."""
        for k in range(len(approach.rows) - 1) if everywhere else approach.suspects():
            found = list(self._between(approach, k))
            passed = approach.offset[k] @ approach.offset[k + 1] < 0
            if not found and passed and (later := self._inside(approach.rows, k, 2.0)):
                # The second integration may reach it slightly later than the run.
                found = list(self._inside_interval(later))[:1]
            # Points that touch and separate on the same side do not reverse the force.
            touched = len(found) == 1 and not passed and approach.distance[k + 1] > self.near
            for time, effect in found if not touched else []:
                yield min(time, float(approach.rows.times[k + 1])), effect

    def _inside_interval(self, approach: _Approach) -> Iterator[tuple[float, float]]:
        for k in approach.suspects():
            yield from self._between(approach, k)

    def _between(self, approach: _Approach, k: int) -> Iterator[tuple[float, float]]:
        """Yield coincidences between two rows."""
        times = approach.rows.times
        if times[k + 1] - times[k] <= self.shortest or approach.distance[k] + approach.distance[k + 1] <= self.near:
            rate, effect = approach.rate[k : k + 2], approach.effect[k : k + 2]
            if rate[0] <= 0 <= rate[1]:
                yield float(times[k]), float(np.mean(effect[rate == 0] if np.any(rate == 0) else effect))
        elif self.samples < MEETING.looks and (inner := self._inside(approach.rows, k, 1.0)):
            yield from self._inside_interval(inner)

    def _inside(self, rows: Rows, k: int, length: float) -> _Approach | None:
        """Integrate from a row over `length` times the interval after it; None if that fails."""
        self.samples += 1
        problem, times = self.integrator.problem, rows.times
        at = replace(problem.point(rows, k), constants=problem.point(rows, k + 1).constants)
        times = times[k] + length * (times[k + 1] - times[k]) * np.linspace(0, 1, MEETING.parts + 1)
        found = integrate_aside(self.integrator, at, times, MEETING.steps)
        if isinstance(found, Refusal):
            return None
        return self.approach(found.since(at))


def first_coincidence(integrator: Integrator, first: Point) -> Violation | None:
    """Return the first coincidence under a force; None if there is none.

    Parameters
    ----------
    integrator : Integrator
        With the results of the run, which stay unchanged.
    first : Point
        Start of the run.
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
    return min(found, key=lambda violation: violation.time, default=None)


def coincidence_ahead(problem: Problem, at: Point, time: float, soon: float) -> str:
    """Return the message on points that would coincide when the run failed; "" if there are none.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Point shortly before.
    time : float
        Time of the failure in s.
    soon : float
        Time in s within which they would coincide.
    """
    statements, column = separations(problem.compiled), 0
    values = problem.each(statements.function, Rows.of(at))[0] if statements.stated else np.empty(0)
    for separation, origin in statements.stated:
        rate, effect, *offset = values[column : (column := column + 2 + separation.offset.sx.numel())]
        if effect and np.linalg.norm(offset) <= MEETING.ahead * -rate * soon:
            return f"{origin}: at t = {time:.6g} s {separation.text}."
    return ""


def _search(search: _Search, rows: Rows, steps: int, text: str) -> list[Violation]:
    approach, n = search.approach(rows), len(rows)
    search.near = MEETING.near * float(np.max(approach.distance))
    least = MEETING.nothing * float(np.max(np.abs(approach.effect)))
    everywhere = n <= MEETING.few and steps > MEETING.steps_a_row * n
    for time, effect in islice(search.coincidences(approach, everywhere), MEETING.harmless):
        if abs(effect) > least:
            return [Violation(time, f"{text.format(time)} (it is {effect:.4g} there).")]
    return []
