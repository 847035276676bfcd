"""Conditions: comparisons of expressions, as piecewise and when take them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca

from acausal.errors import DeclarationError


class Condition:
    """The relation `excess < 0` or `excess <= 0`; join relations by `&` (and), `|` (or), and negate one by `~`.

    Parameters
    ----------
    excess : Expr or field of a class body
        A scalar.
    kind : "<" or "<="
        The relation.
    """

    def __init__(self, excess: Any, kind: str) -> None:
        self.excess = excess
        self.kind = kind

    @property
    def comparisons(self) -> list[Condition]:
        """The comparisons that it is made of: itself, if it is not joined."""
        return [self]

    def replaced(self, new: Callable[[Condition], Condition]) -> Condition:
        """Return the condition with each of its comparisons replaced."""
        return new(self)

    def __and__(self, other: Any) -> Condition:
        return Joined(self, other, every=True)

    def __or__(self, other: Any) -> Condition:
        return Joined(self, other, every=False)

    def __invert__(self) -> Condition:
        return Condition(-self.excess, "<" if self.kind == "<=" else "<=")

    def __bool__(self) -> bool:
        raise DeclarationError(
            "a comparison of symbolic expressions has no truth value while the model is built. "
            "Use piecewise((value, condition), ..., otherwise), as piecewise((a, a > b), b) for max(a, b), or "
            "when(condition, ...), join conditions by & and |, "
            "or declare the field structural(...) if the equations themselves depend on it."
        )


class Joined(Condition):
    """Two conditions of which both must hold (`every`), or one.

    Parameters
    ----------
    a, b : Condition
        The two.
    every : bool
        Whether both must hold.
    """

    def __init__(self, a: Condition, b: Any, every: bool) -> None:
        if not isinstance(b, Condition):
            raise DeclarationError(f"& and | join two conditions such as (x > 0) & (v < 0), not one and {b!r}")
        self.a, self.b, self.every = a, b, every

    @property
    def excess(self) -> Any:  # type: ignore[override]
        """The greater of both if both must hold, the lesser if one is enough; deferred as long as one of them is."""
        a, b = self.a.excess, self.b.excess
        for x in (a, b):
            if getattr(x, "is_deferred", False):
                return x
        if a.shape or b.shape:
            raise DeclarationError("& and | join two conditions that compare scalars")
        return type(a)(ca.fmax(a.sx, b.sx) if self.every else ca.fmin(a.sx, b.sx))

    @property
    def kind(self) -> str:  # type: ignore[override]
        """The relation; where the two differ, the narrower one for both, the wider one for either."""
        kinds = {self.a.kind, self.b.kind}
        return ("<" if self.every else "<=") if len(kinds) == 2 else self.a.kind

    @property
    def comparisons(self) -> list[Condition]:
        """The comparisons that it is made of, from left to right."""
        return [*self.a.comparisons, *self.b.comparisons]

    def replaced(self, new: Callable[[Condition], Condition]) -> Condition:
        """Return the condition with each of its comparisons replaced."""
        return Joined(self.a.replaced(new), self.b.replaced(new), self.every)

    def __invert__(self) -> Condition:
        return Joined(~self.a, ~self.b, not self.every)
