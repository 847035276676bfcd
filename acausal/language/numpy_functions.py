"""Counterparts of numpy functions for expressions and fields of a class body."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

from acausal.language import functions as own
from acausal.language.expression import as_expr, is_deferred
from acausal.language.fields import Deferred


def numpy_functions() -> dict[str, Callable[..., Any]]:
    """Return the counterparts of numpy functions by their numpy names."""

    def of(operate: Callable[..., Any]) -> Callable[..., Any]:
        def call(*values: Any) -> Any:
            # Convert first: the operator of an array would call numpy again.
            return Deferred(operate, values) if is_deferred(*values) else operate(*map(as_expr, values))

        return call

    named = {"arcsin": "asin", "arccos": "acos", "arctan2": "atan2"}
    same = ("sin", "cos", "tan", "exp", "log", "tanh", "sqrt", "sign", "cross", *named)
    operators = {
        "add": operator.add,
        "subtract": operator.sub,
        "multiply": operator.mul,
        "divide": operator.truediv,
        "matmul": operator.matmul,
        "dot": operator.matmul,
        "power": operator.pow,
        "negative": operator.neg,
        "positive": operator.pos,
        "square": lambda x: x**2,
        "equal": operator.eq,
        "less": operator.lt,
        "less_equal": operator.le,
        "greater": operator.gt,
        "greater_equal": operator.ge,
    }
    return (
        {name: getattr(own, named.get(name, name)) for name in same}
        | {name: of(operate) for name, operate in operators.items()}
        | {"absolute": own.absolute, "fabs": own.absolute}
        | {"shape": lambda x: as_expr(x).shape, "ndim": lambda x: len(as_expr(x).shape)}
    )
