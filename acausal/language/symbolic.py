"""What a symbol is not: a Python number or a numpy array. numpy's functions with a counterpart here are replaced by it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from acausal.errors import DeclarationError

# numpy's functions by name, and what they are here; see `twins`.
TWINS: dict[str, Callable[..., Any]] = {}


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
            f"`%`, `//` and round() of {self._shown()} would jump without an event. Count the steps with a discrete variable, "
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
        twin = TWINS.get(function.__name__)
        if twin is None or method != "__call__" or options:
            self._refuse_numpy(function.__name__)
        return twin(*arguments)  # type: ignore[misc]

    def __array_function__(self, function: Any, _: Any, arguments: Any, options: Any) -> Any:
        twin = TWINS.get(function.__name__)
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
