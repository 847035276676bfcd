"""Limits at which a run ends early: steps, seconds, and divergence."""

from __future__ import annotations

import time as clock
from bisect import bisect_left

import numpy as np

from acausal.policy import POLICY
from acausal.solve.integrate.ladder import Failure, Kind
from acausal.solve.integrate.trace import Trace
from acausal.solve.point import Point
from acausal.solve.problem import Problem

DIVERGENCE = POLICY.divergence


class Limits:
    """Limits of a run.

    Parameters
    ----------
    problem : Problem
        The model.
    span : (float, float)
        Start and stop time in s.
    tolerance : float
        Relative tolerance.
    max_steps : int or None
        Steps after which the run ends.
    max_seconds : float or None
        Seconds after which it ends.
    begun : float
        When it began, as of `time.perf_counter`.
    """

    def __init__(
        self,
        problem: Problem,
        span: tuple[float, float],
        tolerance: float,
        max_steps: int | None,
        max_seconds: float | None,
        begun: float,
    ) -> None:
        self.problem, self.span, self.tolerance = problem, span, tolerance
        self.max_steps, self.max_seconds, self.begun = max_steps, max_seconds, begun
        self._times, self._steps = [span[0]], [0]  # at the ends of slices
        self._reached: np.ndarray | None = None

    def left(self, trace: Trace, steps: int) -> int:
        """Return how many of some steps the run may still take."""
        return steps if self.max_steps is None else min(steps, self.max_steps - trace.steps)

    def check(self, at: Point, trace: Trace) -> None:
        """Raise Failure if the run is at one of its limits, or diverges."""
        if self.max_steps is not None and trace.steps >= self.max_steps:
            raise Failure(at.time, f"it has taken max_steps = {self.max_steps} steps", Kind.LIMIT, at)
        if self.max_seconds is not None and clock.perf_counter() - self.begun >= self.max_seconds:
            raise Failure(at.time, f"it has taken max_seconds = {self.max_seconds:g} s", Kind.LIMIT, at)
        if trace.steps > self._steps[-1] and at.time > self._times[-1]:
            self._times.append(at.time)
            self._steps.append(trace.steps)
            self._refuse_divergence(at, trace)

    def _refuse_divergence(self, at: Point, trace: Trace) -> None:
        """Refuse states that grow without bound while steps become ever shorter."""
        begin, end = self.span
        early = begin + DIVERGENCE.early * (end - begin)
        shorter = self._shortening()
        if at.time <= early or shorter < DIVERGENCE.shorter:
            return
        reached, least = self._reached, self.tolerance * self.problem.nominal[: self.problem.nx]
        if reached is None:
            rows = trace.rows(at)
            reached = self._reached = np.max(np.abs(rows.x[1:][rows.times[1:] <= early]), axis=0, initial=0.0)
        growth = np.where(reached > least, np.abs(at.x) / np.maximum(reached, least), 0.0)
        if growth.size and np.max(growth) > DIVERGENCE.growth:
            name = self.problem.compiled.states[int(np.argmax(growth))]
            raise Failure(
                at.time,
                f"it diverges: `{name}` is {np.max(growth):.1g} times as large as in the first tenth of the run, and steps are "
                f"{shorter:.1g} times shorter than in the middle of the time so far. Check the sign of feedback and the "
                "stability of controllers, or end the run earlier, stop_time=...",
                Kind.DIVERGENCE,
                at,
            )

    def _shortening(self) -> float:
        """Return the mean step in the middle of the time so far, over that of the last slice."""
        times = self._times
        return self._mean(bisect_left(times, (times[0] + times[-1]) / 2)) / self._mean(len(times) - 1)

    def _mean(self, k: int) -> float:
        """Return the mean step of a slice."""
        return (self._times[k] - self._times[k - 1]) / (self._steps[k] - self._steps[k - 1])
