"""What a run begins with, kept for the next one: another tolerance, method or grid leaves it as it is."""

from __future__ import annotations

import time as clock
from dataclasses import dataclass

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.once import latest, making
from acausal.solve.checks.validity import check_start
from acausal.solve.initialization.initial_events import Opening
from acausal.solve.initialization.initial_modes import go_on, start
from acausal.solve.initialization.initialize import Start
from acausal.solve.integrate.order import Spectrum
from acausal.solve.point import Point
from acausal.solve.problem import Problem


@dataclass(frozen=True)
class Beginning:
    """Where a run starts, and from where it goes on.

    Attributes
    ----------
    start : Start
        Consistent values.
    at : Point
        The same point, or one beside it where that is singular.
    spectrum : Spectrum
        Eigenvalues there.
    seconds : float
        What it took to find them, without what was made for the model.
    """

    start: Start
    at: Point
    spectrum: Spectrum
    seconds: float


def begin(problem: Problem, time: float, later: float, initial: str) -> Beginning:
    """Find where a run starts, see `start`, or take what the last run of the model found for the same numbers."""
    if initial == "steady":  # a warning of an unstable equilibrium belongs to every run
        return _found(problem, time, later, initial)
    # Equal to the last bit, as numbers are not: 0 and -0 are.
    numbers = np.array([problem.feedback, time, later, *problem.p])
    return kept(problem.compiled, numbers.tobytes(), initial)


def forget(compiled: CompiledModel) -> None:
    """Let the next run find where it starts anew, and measure what that takes."""
    compiled.kept.pop(kept.__wrapped__, None)


@latest(1)
def kept(compiled: CompiledModel, numbers: bytes, initial: str) -> Beginning:
    """Return the beginning of runs with the same feedback, start time, first instant and parameters, given as bytes."""
    (feedback, time, later), p = np.split(np.frombuffer(numbers), [3])
    found = _found(Problem(compiled, p, float(feedback), runs=True), float(time), float(later), initial)
    # Two runs share it.
    for at in (found.start.point, found.at):
        for array in (at.x, at.z, at.mode):
            array.setflags(write=False)
    return found


def _found(problem: Problem, time: float, later: float, initial: str) -> Beginning:
    started, made = clock.perf_counter(), making(problem.compiled)
    begun = start(problem, time, later, initial)
    check_start(problem, begun.point)
    if initial == "steady":
        Opening(problem, time, later).refuse_passing(begun.point)
    at = go_on(problem, begun)
    spectrum, building = Spectrum(problem, at), making(problem.compiled) - made
    return Beginning(begun, at, spectrum, clock.perf_counter() - started - building)
