"""Sizes of states that declare none: what they reach, so that the absolute part of the tolerance fits the machine."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from acausal.compiler import CompiledModel
from acausal.compiler.memo import memoized
from acausal.policy import POLICY
from acausal.solve.problem import Problem, rates_of

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
    groups, rates = _undeclared(problem.compiled)
    # Without a copy of all rows.
    reach = np.maximum.reduce([end for x in rows if len(x) for end in (x.max(axis=0), -x.min(axis=0))])
    fitting = nominal.copy()
    for members in groups:
        most = float(reach[members].max())
        begins = float(np.abs(rows[0][0, members]).max())
        lost = SIZES.lost * tolerance * float(nominal[members].max())
        if most > SIZES.rest * float(problem.nominal[members].max()) and (most > lost or begins > SIZES.smaller * most):
            fitting[members] = np.minimum(nominal[members], most)
    found, most_of = fitting.tolist(), nominal.tolist()
    for coordinate, rate in rates:
        found[rate] = min(most_of[rate], max(found[rate], found[coordinate] / span))
    fitting = np.array(found)
    wrong = fitting < SIZES.smaller * nominal
    return np.where(wrong, fitting, nominal) if wrong.any() else None


@memoized
def _undeclared(compiled: CompiledModel) -> tuple[list[np.ndarray], list[tuple[int, int]]]:
    """States without a declared nominal value: those of each unit, and pairs of a coordinate and such a rate."""
    groups: dict[str, list[int]] = {}
    for k, (unit, declared) in enumerate(compiled.sizes):
        if not declared:
            groups.setdefault(unit, []).append(k)
    rates = [(k, rate) for k, rate in rates_of(compiled) if not compiled.sizes[rate][1]]
    return [np.array(members) for members in groups.values()], rates


def absolute_sizes(compiled: CompiledModel, nominal: np.ndarray) -> dict[str, float]:
    """Return the least size of the states of each unit: outputs below it are not known to the relative tolerance."""
    units, place = _units(compiled)
    found = np.full(len(units), np.inf)
    np.minimum.at(found, place, nominal[: compiled.nx])
    return dict(zip(units, found.tolist(), strict=True))


@memoized
def _units(compiled: CompiledModel) -> tuple[list[str], np.ndarray]:
    """Units of the states, and which of them each state has."""
    units = list(dict.fromkeys(unit for unit, _ in compiled.sizes))
    return units, np.array([units.index(unit) for unit, _ in compiled.sizes], dtype=int)
