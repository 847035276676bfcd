"""Sizes of states that declare none: what they reach, so that the absolute part of the tolerance fits the machine."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.once import once
from acausal.policy import POLICY
from acausal.solve.problem import Problem

SIZES = POLICY.sizes


def smaller_sizes(
    problem: Problem, rows: Sequence[np.ndarray], nominal: np.ndarray, tolerance: float, span: float
) -> np.ndarray | None:
    """Return sizes of states and algebraic unknowns that fit a run better, or None if these do.

    All states of one unit without a declared nominal value have one size, the most that any of them reaches; a rate
    is not followed more closely than its coordinate, which it changes over the whole run.

    Parameters
    ----------
    problem : Problem
        The model.
    rows : sequence of arrays, shapes (n, nx)
        States along the run, from its first point on.
    nominal : array
        Sizes in that run.
    tolerance, span : float
        Relative tolerance, and length of the run in s.
    """
    sizes = problem.compiled.sizes
    ends = np.array([end(x, axis=0) for x in rows if len(x) for end in (np.min, np.max)])
    reach = np.max(np.abs(ends), axis=0, initial=0.0)
    groups: dict[str, list[int]] = {}
    for k, (unit, declared) in enumerate(sizes):
        if not declared:
            groups.setdefault(unit, []).append(k)
    fitting = nominal.copy()
    for members in groups.values():
        most = float(np.max(reach[members]))
        begins = float(np.max(np.abs(rows[0][0, members])))
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
    units, place = _units(compiled)
    found = np.full(len(units), np.inf)
    np.minimum.at(found, place, nominal[: compiled.nx])
    return dict(zip(units, found.tolist(), strict=True))


@once
def _units(compiled: CompiledModel) -> tuple[list[str], np.ndarray]:
    """Units of the states, and which of them each state has."""
    units = list(dict.fromkeys(unit for unit, _ in compiled.sizes))
    return units, np.array([units.index(unit) for unit, _ in compiled.sizes], dtype=int)
