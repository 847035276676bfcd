"""Conditions of piecewise and when: comparisons of expressions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError
from acausal.language.formatting import in_code, short


class Condition:
    """The relation `excess < 0` or `excess <= 0`; join relations by `&` (and), `|` (or), and negate one by `~`.

    Parameters
    ----------
    excess : Expr or field of a class body
        Scalar, the event indicator.
    kind : "<" or "<="
        The relation.
    sides : (left, sign, right)
        Compared values, for messages; () if unknown.
    """

    def __init__(self, excess: Any, kind: str, sides: tuple[Any, ...] = ()) -> None:
        self.excess = excess
        self.kind = kind
        self.sides = sides

    def holds(self, excess: Any) -> Any:
        """Return whether the condition holds for an excess: a number, an array or an expression."""
        return excess < 0 if self.kind == "<" else excess <= 0

    @property
    def comparisons(self) -> list[Condition]:
        """The comparisons of the condition: itself, if it is not joined."""
        return [self]

    def replaced(self, new: Callable[[Condition], Condition]) -> Condition:
        """Return the condition with each of its comparisons replaced."""
        return new(self)

    def __and__(self, other: Any) -> Condition:
        return Joined(self, other, every=True)

    __rand__ = __and__

    def _no_number(self, *_: Any) -> Any:
        raise DeclarationError(
            "an inequality cannot be used as a number. For 1 where it holds and 0 elsewhere write "
            "piecewise((1, a < b), 0)."
        )

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __pow__ = _no_number
    __neg__ = __float__ = __int__ = __lt__ = __le__ = __gt__ = __ge__ = __xor__ = __rxor__ = _no_number
    __array_ufunc__ = None

    def __or__(self, other: Any) -> Condition:
        return Joined(self, other, every=False)

    __ror__ = __or__

    def __invert__(self) -> Condition:
        return Condition(-self.excess, "<" if self.kind == "<=" else "<=")

    def __bool__(self) -> bool:
        raise DeclarationError(undecided(self._said()))

    def __repr__(self) -> str:
        return self._said()

    def _said(self) -> str:
        if not self.sides:
            return "a condition"
        left, sign, right = self.sides
        return f"{short(left)} {sign} {short(right)}"


class Joined(Condition):
    """Conjunction (`every`) or disjunction of two conditions.

    Parameters
    ----------
    a, b : Condition
        The conditions.
    every : bool
        True if both must hold, False if one is enough.
    """

    def __init__(self, a: Condition, b: Any, every: bool) -> None:
        if not isinstance(b, Condition):
            raise DeclarationError(
                f"& and | join two conditions in parentheses, such as (x > 0) & (v < 0), but one operand is {b!r}. Use "
                "Python's `if` for values that are known when the model is built."
            )
        self.a, self.b, self.every, self.sides = a, b, every, ()

    @property
    def excess(self) -> Any:  # type: ignore[override]
        """The maximum of both for a conjunction, the minimum for a disjunction; deferred as long as one of them is."""
        a, b = self.a.excess, self.b.excess
        for x in (a, b):
            if getattr(x, "is_deferred", False) is True:
                return x
        if a.shape or b.shape:
            raise DeclarationError("& and | join two conditions that compare scalars")
        return type(a)(ca.fmax(a.sx, b.sx) if self.every else ca.fmin(a.sx, b.sx))

    @property
    def kind(self) -> str:  # type: ignore[override]
        """The relation; if the two differ, the strict one for a conjunction, the other one for a disjunction."""
        kinds = {self.a.kind, self.b.kind}
        return ("<" if self.every else "<=") if len(kinds) == 2 else self.a.kind

    @property
    def comparisons(self) -> list[Condition]:
        """The comparisons of the condition, from left to right."""
        return [*self.a.comparisons, *self.b.comparisons]

    def replaced(self, new: Callable[[Condition], Condition]) -> Condition:
        """Return the condition with each of its comparisons replaced."""
        return Joined(self.a.replaced(new), self.b.replaced(new), self.every)

    def __invert__(self) -> Condition:
        return Joined(~self.a, ~self.b, not self.every)


def undecided(what: str) -> str:
    """Return the message for an expression whose truth value Python needs while the model is built."""
    return (
        f"{what} is not known while the model is built, so `if`, `and`, `or`, max() and min() cannot use it. Write "
        "piecewise((value, condition), ..., otherwise) or when(condition, ...), and join conditions by & and |; "
        "declare a parameter structural(...) if the equations depend on it."
    )


def refuse_cases(cases: tuple[Any, ...]) -> None:
    """Raise DeclarationError unless the cases are pairs (value, condition) followed by the value otherwise."""
    form = "piecewise((value, condition), ..., otherwise)"
    if not cases:
        raise DeclarationError(f"piecewise() is empty: write {form}.")
    if len(cases) == 1 and isinstance(cases[0], list):
        raise DeclarationError(f"the cases of piecewise are given one by one, not as a list: {form}.")
    for case in cases[:-1]:
        if not isinstance(case, tuple | list) or len(case) != 2:
            raise DeclarationError(
                f"a case of piecewise is a pair (value, condition), but {_shown(case)} is not: {form}."
            )
        value, condition = case
        if isinstance(value, Condition):
            raise DeclarationError(f"a case of piecewise is (value, condition), in this order: {form}.")
        if isinstance(condition, bool):
            raise DeclarationError(
                f"a condition of piecewise is {condition}: it is known when the model is built, and contains no "
                "variable. Write Python's `a if condition else b`, or compare variables: time < 1."
            )
        if not isinstance(condition, Condition):
            what = "an equation, not a condition" if type(condition).__name__ == "Equation" else "not a condition"
            raise DeclarationError(
                f"{_shown(condition)} is {what}: a condition of piecewise compares two scalars by <, <=, > or >=, "
                "such as time < 1."
            )
        if getattr(condition.excess, "shape", ()) and not getattr(condition.excess, "is_deferred", False):
            raise DeclarationError("a condition of piecewise compares two scalars; an entry of a vector is v[0].")
    last = cases[-1]
    if isinstance(last, Condition) or (isinstance(last, tuple | list) and any(isinstance(c, Condition) for c in last)):
        raise DeclarationError(f"piecewise lacks its last argument, the value if no condition holds: {form}.")


def _shown(value: Any) -> str:
    if type(value).__name__ == "Equation":
        return f"`{value.lhs} == {value.rhs}`"
    return in_code(repr(value), f"this {type(value).__name__}")
