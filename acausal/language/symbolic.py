"""What a symbol is not: a Python number, or an array of numpy's. numpy's functions that have a twin here are taken as it."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, ClassVar

from acausal.errors import DeclarationError


class Symbolic:
    """Base of expressions, and of fields in a class body."""

    __slots__ = ()
    _lacks: ClassVar[str]
    _instead: ClassVar[str]

    def _no_number(self, *_: Any) -> Any:
        raise DeclarationError(
            f"{self._shown()} {self._lacks}, so it cannot be a Python number. Use sin, sqrt, ... of acausal on it, or "
            f"{self._instead}."
        )

    __float__ = __int__ = __index__ = __complex__ = _no_number

    def _steps(self, *_: Any) -> Any:
        raise DeclarationError(
            f"`%`, `//` and round() of {self._shown()} would jump unseen. Count the steps with a discrete variable, "
            "when(condition, reinit(...)), or choose with piecewise((value, condition), ..., otherwise)."
        )

    __floordiv__ = __rfloordiv__ = _steps
    __mod__ = __rmod__ = __divmod__ = __rdivmod__ = __round__ = __floor__ = __ceil__ = __trunc__ = _steps

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise DeclarationError(
            f"{self._shown()} {self._lacks}: numpy cannot make an array of it. A tuple or a list is a vector, "
            "(self.x, 0, 0), and one of lists is a matrix."
        )

    def __array_ufunc__(self, function: Any, method: str, *arguments: Any, **options: Any) -> Any:
        twin = _twins().get(function.__name__)
        if twin is None or method != "__call__" or options:
            self._refuse_numpy(function.__name__)
        return twin(*arguments)  # type: ignore[misc]

    def __array_function__(self, function: Any, _: Any, arguments: Any, options: Any) -> Any:
        twin = _twins().get(function.__name__)
        if twin is None or options:
            self._refuse_numpy(function.__name__)
        return twin(*arguments)  # type: ignore[misc]

    def _refuse_numpy(self, name: str) -> Any:
        raise DeclarationError(
            f"numpy's `{name}` takes numbers, and {self._shown()} {self._lacks}. Use the functions of acausal: sin, sqrt, "
            "dot, cross, ...; abs(x); sqrt(dot(v, v)) for a length, sum(v) for a sum, "
            "piecewise((a, a > b), b) for the greater of two."
        )

    def _shown(self) -> str:
        return repr(self)


def _twins() -> dict[str, Callable[..., Any]]:
    from acausal.language import functions as own
    from acausal.language.expression import as_expr, is_deferred
    from acausal.language.fields import Deferred

    def of(operate: Callable[..., Any]) -> Callable[..., Any]:
        def call(*values: Any) -> Any:
            # Not the operator of an array, which would ask numpy again.
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
        "absolute": abs,
        "fabs": abs,
        "equal": operator.eq,
        "less": operator.lt,
        "less_equal": operator.le,
        "greater": operator.gt,
        "greater_equal": operator.ge,
    }
    return (
        {name: getattr(own, named.get(name, name)) for name in same}
        | {name: of(operate) for name, operate in operators.items()}
        | {"shape": lambda x: as_expr(x).shape, "ndim": lambda x: len(as_expr(x).shape)}
    )
