"""Sizes of states that declare none: what they reach, so that the absolute part of the tolerance fits the machine."""

from __future__ import annotations

import numpy as np

from acausal.compiler import CompiledModel
from acausal.policy import POLICY
from acausal.solve.problem import Problem

SIZES = POLICY.sizes


def smaller_sizes(
    problem: Problem, x: np.ndarray, nominal: np.ndarray, tolerance: float, span: float
) -> np.ndarray | None:
    """Return sizes of states and algebraic unknowns that fit a run better, or None if these do.

    All states of one unit without a declared nominal value have one size, the most that any of them reaches; a rate
    is not followed more closely than its coordinate, which it changes over the whole run.

    Parameters
    ----------
    problem : Problem
        The model.
    x : array, shape (n, nx)
        States along the run.
    nominal : array
        Sizes in that run.
    tolerance, span : float
        Relative tolerance, and length of the run in s.
    """
    sizes = problem.compiled.sizes
    reach = np.max(np.abs(x), axis=0, initial=0.0)
    groups: dict[str, list[int]] = {}
    for k, (unit, declared) in enumerate(sizes):
        if not declared:
            groups.setdefault(unit, []).append(k)
    fitting = nominal.copy()
    for members in groups.values():
        most = float(np.max(reach[members]))
        begins = float(np.max(np.abs(x[0, members])))
        lost = SIZES.lost * tolerance * float(np.max(nominal[members]))
        if most > SIZES.rest * float(np.max(problem.nominal[members])) and (
            most > lost or begins > SIZES.smaller * most
        ):
            fitting[members] = np.minimum(nominal[members], most)
    for coordinate, rate in problem.rates:
        if not sizes[rate][1]:
            fitting[rate] = min(nominal[rate], max(fitting[rate], fitting[coordinate] / span))
    wrong = fitting < SIZES.smaller * nominal
    return np.where(wrong, fitting, nominal) if wrong.any() else None


def absolute_sizes(compiled: CompiledModel, nominal: np.ndarray) -> dict[str, float]:
    """Return the least size of the states of each unit: outputs below it are not known to the relative tolerance."""
    found: dict[str, float] = {}
    for (unit, _), size in zip(compiled.sizes, nominal[: compiled.nx].tolist(), strict=True):
        found[unit] = min(size, found.get(unit, np.inf))
    return found
