"""Statements about where a component is right: what must hold, and what should stay small."""

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
    """A condition that must hold and what is wrong where it does not, or a function that checks the value of an expression.

    What is only unusual is a warning.
    """

    subject: Condition | Expr
    problem: str | Callable[[np.ndarray], str]
    warning: bool = False

    @cached_property
    def sx(self) -> ca.SX:
        """What has to be evaluated, a column."""
        return vec(self.subject.excess.sx if isinstance(self.subject, Condition) else self.subject.sx)

    def broken(self, value: np.ndarray) -> str:
        """Return what is wrong with a value, "" if nothing is."""
        if isinstance(self.subject, Condition):
            return "" if self.subject.holds(value[0]) else str(self.problem)
        assert callable(self.problem)
        found = self.problem(value.reshape(self.subject.shape, order="F"))
        return f"`{self.subject}` {found}" if found else ""


@dataclass(frozen=True)
class Expectation:
    """What a component neglects, `part`, should stay below `share` of `whole`; otherwise `text` is a warning."""

    part: Expr
    whole: Expr
    share: float
    text: str


@dataclass(frozen=True)
class Separation:
    """Points whose `offset` must not become 0 while an `effect` acts along their line; `rate` is that of its length."""

    offset: Expr
    rate: Expr
    effect: Expr
    text: str


@checked_call
def require(subject: Any, problem: str | Callable[[np.ndarray], str], warning: bool = False) -> Requirement:
    """State what must hold; yield it in requirements().

    Parameters
    ----------
    subject : Condition or Expr
        Comparison of two scalars, or an expression. Of parameters alone, it is checked when the model is compiled and
        whenever they are changed; of variables, at the start of a simulation.
    problem : str or callable
        What is wrong where the condition does not hold, and the remedy; of an expression, a function that is given its
        value as an array and returns that, or "" if nothing is wrong.
    warning : bool, default False
        True if values that break it are accepted with a warning; only of parameters alone.

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
    """State that something neglected should stay small in a run; yield it in validity().

    Nothing of it is integrated: both are evaluated at the output points of a finished run, and a warning is given once if
    the greatest magnitude of `part` exceeds `share` times that of `whole`.

    Parameters
    ----------
    part, whole : Expr
        Scalars of one unit; a part that is not a number, such as 0 / 0, counts as 0.
    share : float
        What of the whole may be neglected.
    text : str
        What is neglected, and the remedy.
    """
    part, whole = as_expr(part), as_expr(whole)
    if part.shape or whole.shape:
        raise DeclarationError("expect compares two scalars")
    unit_rules.common(part, whole, "the part and the whole of expect")
    return Expectation(part, whole, share, text)


@checked_call
def apart(offset: Any, rate: Any, effect: Any, text: str) -> Separation:
    """State that two points must not meet in a run while something acts along their line; yield it in validity().

    Where they meet, the line has no direction, and what acts along it turns over. Nothing of it is integrated: a run in
    which they met with an effect that is not 0 there ends with a SimulationError, and what came before is kept.

    Parameters
    ----------
    offset : Expr
        Vector from one point to the other.
    rate : Expr
        Derivative of its length.
    effect : Expr
        What acts along the line, positive or negative. Its part proportional to `rate` may act where they meet, as the
        rate turns over as well.
    text : str
        What is wrong, and the remedy.
    """
    offset, rate, effect = as_expr(offset), as_expr(rate), as_expr(effect)
    if len(offset.shape) != 1 or rate.shape or effect.shape:
        raise DeclarationError("apart needs a vector, the offset, and two scalars, rate and effect")
    return Separation(offset, rate, effect, text)
