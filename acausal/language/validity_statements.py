"""Statements on the validity of a component: requirements, small neglected quantities, separated points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.language import unit_rules
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition
from acausal.language.expression import Expr, as_expr
from acausal.symbols import vec


@dataclass(frozen=True)
class Requirement:
    """A required condition with its error text, or an expression with a function that checks its value.

    A violation is an error, or a warning if `warning`.
    """

    subject: Condition | Expr
    problem: str | Callable[[np.ndarray], str]
    warning: bool = False

    @cached_property
    def sx(self) -> ca.SX:
        """The expression to evaluate, a column."""
        return vec(self.subject.excess.sx if isinstance(self.subject, Condition) else self.subject.sx)

    def broken(self, value: np.ndarray) -> str:
        """Return the error text for a value of `sx`, "" if the requirement holds."""
        if isinstance(self.subject, Condition):
            return "" if self.subject.holds(value[0]) else str(self.problem)
        assert callable(self.problem)
        found = self.problem(value.reshape(self.subject.shape, order="F"))
        return f"`{self.subject}` {found}" if found else ""


@dataclass(frozen=True)
class Expectation:
    """A neglected quantity `part` that should stay below `share` of `whole`; otherwise `text` is a warning."""

    part: Expr
    whole: Expr
    share: float
    text: str


@dataclass(frozen=True)
class Separation:
    """Two points whose `offset`, of length rate `rate`, must not vanish while `effect` acts along it."""

    offset: Expr
    rate: Expr
    effect: Expr
    text: str


@checked_call
def require(subject: Any, problem: str | Callable[[np.ndarray], str], warning: bool = False) -> Requirement:
    """State a requirement; yield it in requirements().

    Parameters
    ----------
    subject : Condition or Expr
        Comparison of two scalars, or an expression. With parameters only, it is checked when the model is compiled and
        when they change; with variables, at the start of a simulation.
    problem : str or callable
        Error text with the remedy, for a condition; for an expression, a function of its value, an array, that returns
        the error text, or "" for a valid value.
    warning : bool, default False
        True if a violation is only a warning; for parameters only.

    Examples
    --------
    >>> yield require(self.inner < self.outer, "`inner` is not less than `outer`")  # doctest: +SKIP
    """
    compares = isinstance(subject, Condition) and not subject.excess.shape and isinstance(problem, str)
    if not compares and not (isinstance(subject, Expr) and callable(problem)):
        raise DeclarationError(
            "require needs a condition that compares two scalars and a text, require(self.a < self.b, ...), "
            "or an expression and a function of its value"
        )
    return Requirement(subject, problem, warning)


@checked_call
def expect(part: Any, whole: Any, share: float, text: str) -> Expectation:
    """State that a neglected quantity should stay small in a run; yield it in validity().

    Both are evaluated at the output points of a finished run; a warning is given if the largest magnitude of `part`
    exceeds `share` times that of `whole`.

    Parameters
    ----------
    part, whole : Expr
        Scalars of one unit; a part of value nan, such as 0 / 0, counts as 0.
    share : float
        Share of the whole that may be neglected.
    text : str
        Text of the warning: what is neglected, and the remedy.
    """
    part, whole = as_expr(part), as_expr(whole)
    if part.shape or whole.shape:
        raise DeclarationError("expect compares two scalars")
    unit_rules.common(part, whole, "the part and the whole of expect")
    return Expectation(part, whole, share, text)


@checked_call
def apart(offset: Any, rate: Any, effect: Any, text: str) -> Separation:
    """State that two points must not coincide in a run while an effect acts along their line; yield it in validity().

    Where they coincide, the line has no direction, and the effect reverses. A run in which they coincided with a
    nonzero effect ends with a SimulationError; its result up to there is kept.

    Parameters
    ----------
    offset : Expr
        Vector from one point to the other.
    rate : Expr
        Time derivative of the length of the offset.
    effect : Expr
        Force or other quantity along the line, of either sign. A part proportional to `rate` is allowed where the
        points coincide, as the rate reverses as well.
    text : str
        Error text, with the remedy.
    """
    offset, rate, effect = as_expr(offset), as_expr(rate), as_expr(effect)
    if len(offset.shape) != 1 or rate.shape or effect.shape:
        raise DeclarationError("apart needs a vector, the offset, and two scalars, rate and effect")
    return Separation(offset, rate, effect, text)
