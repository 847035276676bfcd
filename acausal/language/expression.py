"""Symbolic expressions, CasADi SX matrices with a unit, and equations of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.language import unit_rules
from acausal.language.condition import Condition, undecided
from acausal.language.formatting import formatted, kind_of, short
from acausal.language.indexing import selected_entries
from acausal.language.invalid_operands import invalid_operand, number_of, ragged
from acausal.language.quantities import misplaced_quantity
from acausal.language.symbolic import NUMPY_FUNCTIONS, Symbolic
from acausal.language.unit_rules import Unit
from acausal.symbols import combined, picked, vec
from acausal.units import Dimension


class Expr(Symbolic):
    """A symbolic scalar, vector or matrix with its unit.

    Parameters
    ----------
    sx : casadi.SX
        The expression; a scalar is 1 x 1, a vector n x 1.
    unit : Dimension, tuple of Dimension or None
        Unit, one for each row, or None if unknown (as for numbers).
    name : str
        Path of a declared variable or parameter, for messages.
    shape : tuple of int, optional
        Shape as in numpy: (), (n,) or (n, m). Default: one entry is a scalar, one column is a vector, as CasADi knows
        rows and columns only.
    """

    __slots__ = ("name", "shape", "sx", "unit")
    _lacks = "is symbolic and has no value while the model is built"
    _instead = "declare the field structural(...) if it is a size or a count"

    def __init__(self, sx: ca.SX, unit: Unit = None, name: str = "", shape: tuple[int, ...] | None = None) -> None:
        self.sx = sx
        self.unit = unit
        self.name = name
        if shape is None:
            n, m = sx.size1(), sx.size2()
            shape = (n, m) if m != 1 else ((n,) if n != 1 else ())
        self.shape = shape

    def __copy__(self) -> Expr:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Expr:
        return self  # symbols are compared by identity

    @property
    def T(self) -> Expr:
        """Transpose."""
        shape = self.shape[::-1] if len(self.shape) != 1 else (1, *self.shape)
        return Expr(self.sx.T, self.unit if isinstance(self.unit, Dimension) else None, shape=shape)

    def __repr__(self) -> str:
        return self.name or formatted(self.sx, self.shape)

    def __len__(self) -> int:
        return self.sx.shape[0]

    def __getitem__(self, index: Any) -> Expr:
        places = selected_entries(self._shown, self.shape, index)
        # From a column: CasADi returns a row for entries of a row.
        sx = picked(vec(self.sx), places.ravel(order="F").tolist())
        if places.ndim == 2:
            sx = ca.reshape(sx, *places.shape)
        unit: Unit = self.unit if isinstance(self.unit, Dimension) else None
        if isinstance(self.unit, tuple) and not isinstance(index, tuple):
            unit = self.unit[index]  # type: ignore[assignment]
        at = index if isinstance(index, tuple) else (index,)
        whole = self.name and all(isinstance(k, int | np.integer) for k in at)
        return Expr(sx, unit, f"{self.name}[{','.join(map(str, at))}]" if whole else "", places.shape)

    def __setitem__(self, index: Any, value: Any) -> None:
        raise DeclarationError(
            f"entries of {short(self)} cannot be assigned: it is symbolic. Yield an equation for them, `... == ...`, "
            "or build a new vector, (a, b, c)."
        )

    def __iter__(self):
        return (self[k] for k in range(len(self)))

    def __add__(self, other: Any) -> Any:
        return _sum(self, other, "+")

    def __radd__(self, other: Any) -> Any:
        return _sum(other, self, "+")

    def __sub__(self, other: Any) -> Any:
        return _sum(self, other, "-")

    def __rsub__(self, other: Any) -> Any:
        return _sum(other, self, "-")

    def __mul__(self, other: Any) -> Any:
        return _product(self, other)

    def __rmul__(self, other: Any) -> Any:
        return _product(other, self)

    def __truediv__(self, other: Any) -> Any:
        return _quotient(self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return _quotient(other, self)

    def __matmul__(self, other: Any) -> Any:
        return _matrix_product(self, other)

    def __rmatmul__(self, other: Any) -> Any:
        return _matrix_product(other, self)

    def __neg__(self) -> Expr:
        return Expr(-self.sx, self.unit, shape=self.shape)

    def __pos__(self) -> Expr:
        return self

    def __pow__(self, power: Any) -> Any:
        exponent = as_expr(power)
        shape = entrywise(self, "**", exponent)
        return Expr(self.sx**exponent.sx, unit_rules.of_power(self, power), shape=shape)

    def __rpow__(self, base: Any) -> Any:
        return as_expr(base) ** self

    def __abs__(self) -> Any:
        return NUMPY_FUNCTIONS["absolute"](self)

    def __eq__(self, other: object) -> Any:
        return equation(self, other)

    __hash__ = object.__hash__

    def __lt__(self, other: Any) -> Condition:
        return Condition(self - other, "<", (self, "<", other))

    def __le__(self, other: Any) -> Condition:
        return Condition(self - other, "<=", (self, "<=", other))

    def __gt__(self, other: Any) -> Condition:
        return Condition(other - self, "<", (self, ">", other))

    def __ge__(self, other: Any) -> Condition:
        return Condition(other - self, "<=", (self, ">=", other))

    def __bool__(self) -> bool:
        raise DeclarationError(undecided(self._shown()))


@dataclass(frozen=True, eq=False)
class Equation:
    """The statement that two expressions of equal shape are equal."""

    lhs: Expr
    rhs: Expr

    def __bool__(self) -> bool:
        raise DeclarationError(
            "an equation has no truth value: `a == b == c`, `x in [...]` and `if a == b` cannot be used with symbolic "
            "expressions. Yield one equation for each `==`."
        )


def as_expr(value: Any) -> Expr:
    """Return a number, a nested sequence of numbers and expressions, an array or an expression as an Expr."""
    if isinstance(value, Expr):
        return value
    if isinstance(value, int | float | np.integer | np.floating | np.bool_):
        return _number(number_of(value))
    if wrong := misplaced_quantity(value):
        raise DeclarationError(f"an expression contains {wrong}")
    if isinstance(value, np.ndarray) and value.dtype.kind in "buif" and value.ndim <= 2:
        number: Any = value
        return Expr(ca.SX(ca.sparsify(ca.DM(number))), shape=value.shape)
    if isinstance(value, np.ndarray):
        return as_expr(value.tolist())
    if isinstance(value, ca.DM | ca.SX):
        return Expr(ca.SX(value))
    if isinstance(value, Sequence) and not isinstance(value, str):
        rows = [as_expr(item) for item in value]
        if any(row.shape != rows[0].shape or len(row.shape) > 1 for row in rows):
            raise DeclarationError(ragged([row.shape for row in rows], value))
        inner = rows[0].shape if rows else ()
        entries = [row.sx for row in rows]
        sx = ca.horzcat(*entries).T if inner else ca.vertcat(*entries)
        return Expr(sx, unit_rules.of_array(rows), shape=(len(rows), *inner))
    raise DeclarationError(invalid_operand(value))


@lru_cache(maxsize=1024)
def _number(value: float) -> Expr:
    return Expr(ca.SX(value) if value else ca.SX(1, 1))


def equation(lhs: Any, rhs: Any) -> Any:
    """State that two expressions are equal.

    Raises
    ------
    DeclarationError
        If the shapes differ.
    UnitsError
        If the units differ for certain.
    """
    if is_deferred(lhs, rhs):
        raise DeclarationError("an equation is stated inside equations(), with self.<name>, not in the class body.")
    a, b = as_expr(lhs), as_expr(rhs)
    if a.shape != b.shape:
        raise DeclarationError(
            f"the sides of an equation are {kind_of(a.shape)} and {kind_of(b.shape)}: {short(a)} == {short(b)}. "
            "Both need the same shape: (0, 0, 0) is a vector of zeros, v[0] an entry of v."
        )
    for side in (a, b):
        if side.sx.is_constant() and not side.sx.is_regular():
            raise DeclarationError(f"a side of an equation is {short(side)}; it must be finite.")
    unit_rules.common(a, b, "joined by `==`")
    return Equation(a, b)


def is_deferred(*values: Any) -> bool:
    """Return whether a value is a field of a class body, evaluated when the model is built."""
    return any(getattr(value, "is_deferred", False) is True for value in values)


def entrywise(a: Expr, symbol: str, b: Expr) -> tuple[int, ...]:
    """Return the shape of an entrywise operation on two equal shapes, or with a scalar.

    Raises
    ------
    DeclarationError
        If the shapes do not fit.
    """
    if a.shape and b.shape and a.shape != b.shape:
        raise DeclarationError(_misfit(a, symbol, b))
    return a.shape or b.shape


def _misfit(a: Expr, symbol: str, b: Expr) -> str:
    return f"{kind_of(a.shape)} and {kind_of(b.shape)} do not fit: {short(a)} {symbol} {short(b)}."


def _sum(left: Any, right: Any, symbol: str) -> Any:
    if is_deferred(left, right):
        return NotImplemented
    a, b = as_expr(left), as_expr(right)
    if a.shape != b.shape:
        raise DeclarationError(_misfit(a, symbol, b))
    return Expr(combined(a.sx, symbol, b.sx), unit_rules.common(a, b, f"joined by `{symbol}`"), shape=a.shape)


def _product(left: Any, right: Any) -> Any:
    if is_deferred(left, right):
        return NotImplemented
    a, b = as_expr(left), as_expr(right)
    if a.shape and b.shape and a.shape != b.shape:
        raise DeclarationError(f"{_misfit(a, '*', b)} Use @ for matrices.")
    return Expr(combined(a.sx, "*", b.sx), unit_rules.of_product(a, b), shape=a.shape or b.shape)


def _matrix_product(left: Any, right: Any) -> Any:
    if is_deferred(left, right):
        return NotImplemented
    a, b = as_expr(left), as_expr(right)
    if not a.shape or not b.shape or a.shape[-1] != b.shape[0]:
        raise DeclarationError(_misfit(a, "@", b))
    unit = unit_rules.of_inner_product(a, b)
    if len(a.shape) == len(b.shape) == 1:
        return Expr(ca.dot(a.sx, b.sx), unit)
    return Expr(b.sx.T @ a.sx if len(a.shape) == 1 else a.sx @ b.sx, unit, shape=a.shape[:-1] + b.shape[1:])


def _quotient(left: Any, right: Any) -> Any:
    if is_deferred(left, right):
        return NotImplemented
    a, b = as_expr(left), as_expr(right)
    if b.shape:
        raise DeclarationError(f"cannot divide by {kind_of(b.shape)}: {short(b)}.")
    return Expr(combined(a.sx, "/", b.sx), unit_rules.of_quotient(a, b), shape=a.shape)
