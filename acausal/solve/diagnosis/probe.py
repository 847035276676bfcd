"""Residuals and Jacobian of all equations at a point, and their zero parameters, to diagnose failures there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.full_residuals import FullResiduals, Row, full_residuals
from acausal.policy import POLICY
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars

CAUSES = POLICY.causes
ROUNDING = POLICY.newton.terms * np.finfo(float).eps


@dataclass(frozen=True)
class Probe:
    """All equations of a model at a point, those included that are solved explicitly."""

    whole: FullResiduals
    p: np.ndarray
    at: Point
    flag: float
    unknowns: np.ndarray

    @classmethod
    def of(cls, problem: Problem, at: Point, flag: float) -> Probe:
        """Return the probe at a point; `flag` is 1 while the initial system holds."""
        return cls(full_residuals(problem.compiled), problem.p, at, flag, problem.unknowns(at, flag))

    @property
    def arguments(self) -> tuple[Any, ...]:
        """Arguments of the equations; unknowns that are not finite get an ordinary value, to tell failing equations apart."""
        known = np.where(np.isfinite(self.unknowns), self.unknowns, CAUSES.ordinary)
        return known, self.p, self.at.time, self.at.constants.vector, self.flag

    def failing(self) -> list[Row]:
        """Equations that are not finite for finite unknowns."""
        wrong = ~np.isfinite(self.whole.values(*self.arguments)[0])
        return [row for row, fails in zip(self.whole.rows, wrong, strict=True) if fails]

    def jacobian(self) -> np.ndarray:
        """Jacobian by the unknowns that are solved for; entries at round-off level are 0."""
        J, changed = (self.whole.jacobian(*at.arguments) for at in (self, replace(self, p=perturbed(self.p))))
        return np.where(is_round_off(J, changed), 0.0, J)

    def with_parameters(self, places: Sequence[int], value: float) -> Probe:
        """Return the probe with another value of some parameters."""
        p = self.p.copy()
        p[list(places)] = value
        return replace(self, p=p)


def decisive_zeros(problem: Problem, rows: list[Row], matters: Callable[[Sequence[int]], bool]) -> list[str]:
    """Return the parameters whose value 0 makes some equations fail: single ones, else whole arrays.

    Parameters
    ----------
    problem : Problem
        The model.
    rows : list of Row
        The equations.
    matters : callable
        Return whether the equations are regular with other values of the parameters at some places.
    """
    own = problem.compiled.reduced.flat.parameters
    inside = {s.element_hash() for row in rows for s in ca.symvar(row.expression)}
    symbols = scalars(own.symbols)
    zeros = {own.names[k]: k for k, s in enumerate(symbols) if s.element_hash() in inside and problem.p[k] == 0}
    if alone := [name for name, k in zeros.items() if matters([k])]:
        return alone
    arrays: dict[str, list[int]] = {}
    for name, k in zeros.items():
        array, _, index = name.removesuffix("]").partition("[")
        if index and len(set(index.split(","))) == 1:  # a vector, or the diagonal of a matrix
            arrays.setdefault(array, []).append(k)
    return [array for array, places in arrays.items() if len(places) > 1 and matters(places)]


def zeros_text(names: list[str]) -> str:
    """Return the message that some parameters must not be 0."""
    shown = " and ".join(f"`{name}`" for name in names[: CAUSES.shown])
    verb = "is" if len(names) == 1 else "are"
    return f"{shown} {verb} 0, which the equations do not allow. Give another value."


def perturbed(p: np.ndarray) -> np.ndarray:
    """Return parameters with relative changes at round-off level."""
    return p * _changes(len(p))


@cache
def _changes(n: int) -> np.ndarray:
    return 1 + ROUNDING * np.random.default_rng(0).standard_normal(n)


def is_round_off(entries: np.ndarray, perturbed: np.ndarray) -> np.ndarray:
    """Return which entries of a Jacobian are round-off: perturbed parameters change them by their own size.

    Parameters
    ----------
    entries, perturbed : arrays of the same shape
        Entries for the parameters, and for the perturbed ones.
    """
    return (entries != 0) & (np.abs(perturbed - entries) >= np.abs(entries))
