"""Initial point of a run, shared with the next run: it does not depend on tolerance, method and output times."""

from __future__ import annotations

import time as clock
from dataclasses import dataclass

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memo_seconds, memoized_latest
from acausal.solve.checks.validity import check_start
from acausal.solve.initialization.initial_events import InitialEvents
from acausal.solve.initialization.initial_modes import leave_singular_start, start
from acausal.solve.initialization.initialize import Start
from acausal.solve.integrate.order import Spectrum
from acausal.solve.point import Point
from acausal.solve.problem import Problem


@dataclass(frozen=True)
class InitialPoint:
    """Initial point of a run, and the point from which it is integrated.

    Attributes
    ----------
    start : Start
        Consistent values.
    at : Point
        The same point, or one next to it if that is singular.
    spectrum : Spectrum
        Eigenvalues at the point.
    seconds : float
        Time of the initialization, without that of compiling functions.
    """

    start: Start
    at: Point
    spectrum: Spectrum
    seconds: float


def initial_point(problem: Problem, time: float, later: float, initial: str) -> InitialPoint:
    """Return the initial point, see `start`, or that of the last run of the model if all numbers are the same."""
    if initial == "steady":  # every run shall warn of an unstable equilibrium
        return _computed(problem, time, later, initial)
    # As bytes: 0 and -0 are equal numbers.
    numbers = np.array([problem.feedback, time, later, *problem.p])
    return shared_point(problem.compiled, numbers.tobytes(), initial)


def forget(compiled: CompiledModel) -> None:
    """Discard the stored initial point, so that the next run computes it and measures the time."""
    compiled.memo.pop(shared_point.__wrapped__, None)


@memoized_latest(1)
def shared_point(compiled: CompiledModel, numbers: bytes, initial: str) -> InitialPoint:
    """Return the initial point for the bytes of feedback, start time, first event time and parameters."""
    (feedback, time, later), p = np.split(np.frombuffer(numbers), [3])
    found = _computed(Problem(compiled, p, float(feedback), runs=True), float(time), float(later), initial)
    # Runs share these arrays.
    for at in (found.start.point, found.at):
        for array in (at.x, at.z, at.mode):
            array.setflags(write=False)
    return found


def _computed(problem: Problem, time: float, later: float, initial: str) -> InitialPoint:
    started, made = clock.perf_counter(), memo_seconds(problem.compiled)
    begun = start(problem, time, later, initial)
    check_start(problem, begun.point)
    if initial == "steady":
        InitialEvents(problem, time, later).refuse_transient(begun.point)
    at = leave_singular_start(problem, begun, later)
    spectrum, building = Spectrum(problem, at), memo_seconds(problem.compiled) - made
    return InitialPoint(begun, at, spectrum, clock.perf_counter() - started - building)
