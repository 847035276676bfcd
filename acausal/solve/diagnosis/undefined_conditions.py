"""Conditions that have no value, such as sqrt(x) > 1 where x is negative, so that nothing tells what holds."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler.whole import EVENT, whole
from acausal.solve.diagnosis.not_finite import undefined_equations
from acausal.solve.point import Point
from acausal.solve.problem import Problem

REMEDY = "Nothing tells whether it holds. Compare what always has a value, such as x > 1 in place of sqrt(x) > 1."
NO_VALUE = "a condition has no value; check what it divides by, and the arguments of sqrt, log, acos"


def undefined_conditions(problem: Problem, at: Point, guards: Iterable[int]) -> str:
    """Say which of some conditions without a value matter at a point, "" if none does; the time is not told.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where.
    guards : iterable of int
        Conditions that have no value there.
    """
    if not any(_matters(problem, at, k) for k in guards):
        return ""
    return undefined_equations(problem, at, kinds=(EVENT,), remedy=REMEDY, timed=False) or NO_VALUE


def _matters(problem: Problem, at: Point, guard: int) -> bool:
    """Whether an equation says something else where a condition holds; what acts at an instant always matters."""
    compiled = problem.compiled
    if guard >= compiled.guards.n_switches:
        return True
    own, unknowns = whole(compiled), problem.unknowns(at)
    found = []
    for holds in (False, True):
        constants = at.constants.switched([guard], [holds]).vector
        found.append(own.values(unknowns, problem.p, at.time, constants, 0.0)[0].copy())
    return not np.array_equal(*found, equal_nan=True)
