"""Conditions that are undefined at a point, such as sqrt(x) > 1 for negative x."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from acausal.compiler.full_residuals import EVENT, full_residuals
from acausal.solve.diagnosis.not_finite import undefined_equations
from acausal.solve.point import Point
from acausal.solve.problem import Problem

REMEDY = (
    "It is neither true nor false. Compare expressions that are always defined, such as x > 1 instead of sqrt(x) > 1."
)
NO_VALUE = "a condition has no value; check what it divides by, and the arguments of sqrt, log, acos"


def undefined_conditions(problem: Problem, at: Point, guards: Iterable[int]) -> str:
    """Return the message on undefined conditions that matter at a point, without the time; "" if none does.

    Parameters
    ----------
    problem : Problem
        The model.
    at : Point
        Where.
    guards : iterable of int
        Conditions that are undefined there.
    """
    if not any(_matters(problem, at, k) for k in guards):
        return ""
    return undefined_equations(problem, at, kinds=(EVENT,), remedy=REMEDY, timed=False) or NO_VALUE


def _matters(problem: Problem, at: Point, guard: int) -> bool:
    """Return whether any equation depends on a condition; conditions that trigger events always matter."""
    compiled = problem.compiled
    if guard >= compiled.guards.n_switches:
        return True
    own, unknowns = full_residuals(compiled), problem.unknowns(at)
    found = []
    for holds in (False, True):
        constants = at.constants.switched([guard], [holds]).vector
        found.append(own.values(unknowns, problem.p, at.time, constants, 0.0)[0].copy())
    return not np.array_equal(*found, equal_nan=True)
