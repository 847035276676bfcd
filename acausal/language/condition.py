"""Conditions: comparisons of expressions, as piecewise and when take them."""

from __future__ import annotations

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

    def __and__(self, other: Any) -> Condition:
        return self._joined(other, ca.fmax, "<")

    def __or__(self, other: Any) -> Condition:
        return self._joined(other, ca.fmin, "<=")

    def __invert__(self) -> Condition:
        return Condition(-self.excess, "<" if self.kind == "<=" else "<=")

    def _joined(self, other: Any, join: Any, strongest: str) -> Condition:
        if not isinstance(other, Condition):
            raise DeclarationError(f"& and | join two conditions such as (x > 0) & (v < 0), not one and {other!r}")
        a, b = self.excess, other.excess
        if getattr(a, "is_deferred", False) or getattr(b, "is_deferred", False):
            raise DeclarationError("conditions with fields are joined inside equations() only, with self.<name>")
        kinds = {self.kind, other.kind}
        return Condition(type(a)(join(a.sx, b.sx)), strongest if len(kinds) == 2 else kinds.pop())

    def __bool__(self) -> bool:
        raise DeclarationError(
            "a comparison of symbolic expressions has no truth value while the model is built. "
            "Use piecewise((value, condition), ..., otherwise) or when(condition, ...), join conditions by & and |, "
            "or declare the field structural(...) if the equations themselves depend on it."
        )
