"""Units of sums, products and arrays: only certain contradictions are reported.

A literal takes the unit that the equation requires, as a term (x == 2, x + 1) and as a factor (9.81 * h, E / 2, 1 / T),
whatever its value: gains of 400 and of 1 are written alike. A product with a literal therefore has an unknown unit,
which is compatible with every unit. So have fields declared without a unit, and products of a vector with a matrix of
numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, Protocol

import casadi as ca

from acausal.errors import UnitsError
from acausal.language.formatting import short
from acausal.units import Dimension

Unit = Dimension | tuple[Dimension | None, ...] | None


class Measured(Protocol):
    """An expression with its unit."""

    sx: ca.SX
    unit: Unit

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape as in numpy."""
        ...

    def __iter__(self) -> Iterator[Any]: ...


def common(a: Measured, b: Measured, where: str) -> Unit:
    """Return the common unit of two expressions, such as the terms of a sum.

    Parameters
    ----------
    a, b : Measured
        Expressions of equal shape.
    where : str
        What joins the expressions, for the message.

    Raises
    ------
    UnitsError
        If the units differ for certain.
    """
    if a.unit is None or b.unit is None or a.unit == b.unit:
        return b.unit if a.unit is None else a.unit
    pairs = list(zip(_entries(a), _entries(b), strict=True))
    if any(u is not None and v is not None and u != v for u, v in pairs):
        raise UnitsError(f"units differ: {short(a)} is in [{_text(a)}], {short(b)} in [{_text(b)}], {where}.")
    return _merged([v if u is None else u for u, v in pairs])


def check_value(own: Measured, value: Measured) -> None:
    """Raise UnitsError if the unit of a value differs for certain from that of its parameter."""
    try:
        common(own, value, "its value")
    except UnitsError:
        given = short(value)
        given = f'quantity({given}, "{_text(value)}")' if value.sx.is_constant() else f"{given}, in {_text(value)}"
        raise UnitsError(f"the unit of `{own!r}` is {_text(own)}, but it is given as {given}.") from None


def of_product(a: Measured, b: Measured) -> Unit:
    """Return the unit of a * b, entry by entry."""
    return _combined(a, b, lambda u, v: u * v)


def of_quotient(a: Measured, b: Measured) -> Unit:
    """Return the unit of a / b for a scalar b."""
    return _combined(a, b, lambda u, v: u / v)


def of_inner_product(a: Measured, b: Measured) -> Unit:
    """Return the unit of a @ b.

    Raises
    ------
    UnitsError
        If the products in the sum differ in unit for certain.
    """
    if isinstance(a.unit, Dimension) and isinstance(b.unit, Dimension):
        return a.unit * b.unit
    if len(a.shape) != 1 or len(b.shape) != 1 or a.unit is None or b.unit is None:
        return None
    terms = [x * y for x, y in zip(a, b, strict=True)]
    total = terms[0]
    for term in terms[1:]:
        total = type(total)(total.sx + term.sx, common(total, term, "terms of a scalar product"))
    # The sum is certain only if all its terms are.
    unknown = any(t.unit is None and not t.sx.is_zero() for t in terms)
    return None if unknown else total.unit


def of_power(base: Measured, power: Any) -> Unit:
    """Return the unit of a power with a numeric exponent."""
    if not isinstance(power, int | float | Fraction) or base.unit is None:
        return None
    exact = Fraction(power).limit_denominator(1000)
    if abs(exact - power) > 1e-12:
        return None
    return _merged([u if u is None or exact == 1 else u ** _plain(exact) for u in _entries(base)])


def of_array(items: Sequence[Measured]) -> Unit:
    """Return the unit of an array of entries or rows; zero entries are compatible with the others."""
    units = [item.unit for item in items if not (item.unit is None and item.sx.is_zero())]
    if units and isinstance(units[0], Dimension) and all(u == units[0] for u in units):
        return units[0]
    if any(item.shape for item in items):
        return None
    return _merged([item.unit if isinstance(item.unit, Dimension) else None for item in items])


def _combined(a: Measured, b: Measured, operate: Any) -> Unit:
    if isinstance(a.unit, Dimension) and isinstance(b.unit, Dimension):
        return operate(a.unit, b.unit)
    if a.unit is None or b.unit is None:
        return None
    size = max(len(_entries(a)), len(_entries(b)))
    pairs = zip(*(u * size if len(u) == 1 else u for u in (_entries(a), _entries(b))), strict=True)
    return _merged([None if u is None or v is None else operate(u, v) for u, v in pairs])


def _entries(value: Measured) -> list[Dimension | None]:
    """Return the unit of each row."""
    unit = value.unit
    return list(unit) if isinstance(unit, tuple) else [unit] * value.sx.shape[0]


def _merged(units: Sequence[Dimension | None]) -> Unit:
    same = all(u == units[0] for u in units) if units else True
    return (units[0] if units else None) if same else tuple(units)


def _plain(power: Fraction) -> int | Fraction:
    return int(power) if power.denominator == 1 else power


def _text(value: Measured) -> str:
    if isinstance(value.unit, tuple):
        return ", ".join("?" if u is None else str(u) for u in value.unit)
    return str(value.unit)
