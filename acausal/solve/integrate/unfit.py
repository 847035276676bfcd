"""Where the constraints of closed loops that are kept, of some that follow from one another, no longer hold the others."""

from __future__ import annotations

import numpy as np

from acausal.policy import POLICY
from acausal.solve.initialization.independent_constraints import IndependentConstraints
from acausal.solve.point import Point
from acausal.solve.problem import Problem

LOOPS = POLICY.loops


def unfit_time(held: IndependentConstraints, begin: float) -> float | None:
    """Return a time in s at which other constraints are to be kept, None if those that are stay fit.

    It is that of the last point at which they are fit if they are no longer fairly so there, else between that and the next one.

    Parameters
    ----------
    held : IndependentConstraints
        The constraints at successive steps or outputs.
    begin : float
        Time in s at which the call began.
    """
    if held.constants.all_count or (after := _first_unfit(held)) is None:
        return None
    before, (times, found) = after - 1, (held.times, held.conditioning)
    if times[before] > begin and found[before] < LOOPS.fairly:
        return float(times[before])
    middle = float((times[before] + times[after]) / 2)
    return middle if middle > begin else None


def fit_rows(held: IndependentConstraints) -> int:
    """Return the number of points before the first in which the constraints that are kept are unfit, after the first of all."""
    unfit = _first_unfit(held)
    return len(held.times) - 1 if unfit is None else unfit - 1


def _first_unfit(held: IndependentConstraints) -> int | None:
    """Place of the first point in which they are unfit, or where none is quite fit at the first one much less so."""
    found = held.conditioning
    unfit = np.flatnonzero(found[1:] < LOOPS.unfit * (1.0 if found[0] >= LOOPS.unfit else found[0]))
    return 1 + int(unfit[0]) if unfit.size else None


def parted(times: np.ndarray, time: float) -> tuple[np.ndarray, np.ndarray]:
    """Part some times at one of them that is a rounding error away, or at a time between them."""
    near = times[np.argmin(np.abs(times - time))]
    if times[0] < near < times[-1] and abs(near - time) <= POLICY.calls.here * (times[-1] - times[0]):
        time = near
    return np.append(times[times < time], time), np.append(time, times[times > time])


class Reach:
    """How far one integrates in a call where the constraints that are kept may become unfit on the way."""

    def __init__(self) -> None:
        self._length: float | None = None

    def parts(self, problem: Problem, at: Point, times: np.ndarray, stepwise: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return the times of the next call, and the rest, which begins with its end.

        Parameters
        ----------
        problem : Problem
            The model.
        at : Point
            Where the call begins.
        times : array
            Time of that point and output times, in s.
        stepwise : bool
            Whether what is kept is looked at while it goes on, not after it.
        """
        if at.constants.all_count:
            return times, times[-1:]
        if self._length is None and not stepwise:
            self._length = _first_length(problem, at)
        if self._length is None or at.time + self._length >= times[-1]:
            return times, times[-1:]
        return parted(times, at.time + self._length)

    def ended(self, time: float) -> None:
        """Note after what time in s constraints became unfit."""
        self._length = time

    def lasted(self, time: float, stepwise: bool) -> None:
        """Note that they did not in that time."""
        if stepwise:
            self._length = None
        elif self._length is not None and time >= self._length * (1 - POLICY.calls.here):
            self._length *= 2


def _first_length(problem: Problem, at: Point) -> float:
    """Time in s in which states of loops move by some nominal values, as fast as they and their rates change at a point.

    Without end where what is dropped is 0 beside what is kept, as out of the plane of a planar loop.
    """
    if IndependentConstraints.at(problem, at).conditioning[0] > 1 - POLICY.ranks.nearly:
        return np.inf
    states = problem.compiled.constraints.states
    fastest = np.max(np.abs(problem.values(at)[states]) / problem.nominal[states], initial=0.0)
    return float(LOOPS.first / fastest) if np.isfinite(fastest) and fastest > 0 else np.inf
