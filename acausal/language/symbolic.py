"""Behaviour of symbols in Python and numpy: operations without meaning are errors, numpy functions are replaced."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from acausal.errors import DeclarationError
from acausal.language.formatting import short

# Name of a numpy function -> its counterpart for expressions; see `numpy_functions`.
NUMPY_FUNCTIONS: dict[str, Callable[..., Any]] = {}


FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan2", "exp", "log", "tanh", "sqrt", "sign", "dot", "cross")
_STEPS = (
    "the steps as a discrete variable, when(condition, reinit(...)), or piecewise((value, condition), ..., otherwise)"
)
_TUPLE = "a vector as a tuple of its entries, (a, b, c)"
# Name of a numpy function without counterpart -> what to write instead.
INSTEAD = {
    "norm": "sqrt(dot(v, v)) for the length of v",
    "hypot": "sqrt(a**2 + b**2)",
    "where": "piecewise((a, condition), b)",
    "select": "piecewise((a, condition), (b, other), otherwise)",
    "clip": "acausal's clip(x, low, high)",
    "maximum": "acausal's maximum(a, b)",
    "minimum": "acausal's minimum(a, b)",
    "floor": "acausal's floor(x)",
    "remainder": "acausal's mod(x, y)",
    "heaviside": "piecewise((1, x > 0), 0)",
    "interp": "table(x, Table([x0, x1], [y0, y1]))",
    "sum": "sum(v)",
    "mean": "sum(v) / 3, with the number of entries",
    "arctan": "atan2(x, 1)",
    "sinh": "(exp(x) - exp(-x)) / 2",
    "cosh": "(exp(x) + exp(-x)) / 2",
    "log10": "log(x) / log(10)",
    "log2": "log(x) / log(2)",
    "deg2rad": "x * (pi / 180)",
    "radians": "x * (pi / 180)",
    "rad2deg": "x * (180 / pi)",
    "degrees": "x * (180 / pi)",
    "inv": "the unknowns as variables, and their equation: A @ x == b",
    "solve": "the unknowns as variables, and their equation: A @ x == b",
    "transpose": "A.T",
    "inner": "dot(a, b)",
    "vdot": "dot(a, b)",
    "not_equal": "piecewise((a, x < y), (b, x > y), otherwise)",
    "gradient": "der(x) for the derivative with respect to time",
    "diff": "der(x) for the derivative with respect to time",
    "trapz": "the integral as a state, der(s) == x",
} | dict.fromkeys(("ceil", "rint", "trunc", "round", "around", "fmod", "floor_divide"), _STEPS)
INSTEAD |= dict.fromkeys(("hstack", "vstack", "stack", "concatenate", "append", "array"), _TUPLE)


class Symbolic:
    """Base class of expressions and of fields in a class body."""

    __slots__ = ()
    _lacks: ClassVar[str]
    _instead: ClassVar[str]

    def _no_number(self, *_: Any) -> Any:
        raise DeclarationError(
            f"{self._shown()} {self._lacks}, so it cannot be a Python number. Instead of math's functions use those of "
            f"acausal: sin, sqrt, atan2, ...; or {self._instead}."
        )

    __float__ = __int__ = __index__ = __complex__ = _no_number

    def _steps(self, *_: Any) -> Any:
        raise DeclarationError(
            f"`%`, `//` and round() of {self._shown()} would jump without an event. Count the steps with a discrete "
            "variable, when(condition, reinit(...)), or choose with piecewise((value, condition), ..., otherwise)."
        )

    def _join(self, *_: Any) -> Any:
        raise DeclarationError(
            f"`&` and `|` join conditions, not {self._shown()}: put each condition in parentheses: (x > 0) & (x < 1)."
        )

    def _caret(self, *_: Any) -> Any:
        raise DeclarationError("a power is written x**2, not x ^ 2.")

    __and__ = __rand__ = __or__ = __ror__ = __invert__ = _join
    __xor__ = __rxor__ = _caret

    def __format__(self, spec: str) -> str:
        return repr(self) if not spec else self._no_number()

    __floordiv__ = __rfloordiv__ = _steps
    __mod__ = __rmod__ = __divmod__ = __rdivmod__ = __round__ = __floor__ = __ceil__ = __trunc__ = _steps

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise DeclarationError(
            f"{self._shown()} {self._lacks}: numpy cannot make an array of it. A tuple or a list is a vector, "
            "(self.x, 0, 0), one of lists is a matrix; dot, cross and @ take them."
        )

    def __array_ufunc__(self, function: Any, method: str, *arguments: Any, **options: Any) -> Any:
        counterpart = NUMPY_FUNCTIONS.get(function.__name__)
        if counterpart is None or method != "__call__" or options:
            self._refuse_numpy(function.__name__)
        return counterpart(*arguments)  # type: ignore[misc]

    def __array_function__(self, function: Any, _: Any, arguments: Any, options: Any) -> Any:
        counterpart = NUMPY_FUNCTIONS.get(function.__name__)
        if counterpart is None or options:
            self._refuse_numpy(function.__name__)
        return counterpart(*arguments)  # type: ignore[misc]

    def _refuse_numpy(self, name: str) -> Any:
        remedy = INSTEAD.get(name) or f"acausal has {', '.join(FUNCTIONS)}, abs, min by piecewise, and sum(v)"
        raise DeclarationError(f"numpy's `{name}` takes numbers, and {self._shown()} {self._lacks}. Write {remedy}.")

    def _shown(self) -> str:
        return short(self)
