"""Conversion of values from the user to numbers, with errors for wrong types and shapes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import DeclarationError
from acausal.language.condition import Condition
from acausal.language.expression import Expr
from acausal.language.fields import InitialValue
from acausal.language.formatting import short
from acausal.language.invalid_operands import decimal_point
from acausal.language.quantities import misplaced_quantity
from acausal.language.symbolic import Symbolic
from acausal.language.value_checks import shown
from acausal.units import in_si

LARGEST = float(np.sqrt(np.finfo(float).max))  # largest magnitude whose square is finite


def numeric(value: Any, shape: tuple[int, ...] | None, where: str, remedy: str = "") -> np.ndarray:
    """Return a value as an array of finite numbers.

    Parameters
    ----------
    value : object
        Value from the user.
    shape : tuple of int, optional
        Required shape; None for any.
    where : str
        Name of the field, for messages.
    remedy : str, optional
        Remedy for a wrong type or shape; a sentence.

    Raises
    ------
    DeclarationError
        If the value is not a finite number, or an array of another shape.
    """
    if type(value) is float and not shape and -LARGEST <= value <= LARGEST:
        return np.array(value)
    if wrong := misplaced_quantity(value):
        raise DeclarationError(f"{where} is {wrong}")
    single = shape == () or (shape is None and not _is_listed(value))
    try:
        if _has_no_number(value):
            raise TypeError
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        wanted = "a number" if single else "an array of numbers" + (f" of shape {shape}" if shape else "")
        si = in_si(value) if isinstance(value, str) and single else None
        hint = (
            f", in SI units without the unit: {si:.12g}" if si is not None else decimal_point(value) if single else ""
        )
        more = f" {remedy}" if remedy and not hint else ""
        raise DeclarationError(f"{where} is {_written(value)}; it must be {wanted}{hint}.{more}") from None
    except OverflowError:
        raise DeclarationError(f"{where} has more than 300 digits; it must be finite.") from None
    if shape is not None and array.shape != shape:
        raise DeclarationError(misshapen(where, value, array.shape, shape, remedy))
    if not all(math.isfinite(x) for x in array.flat):
        raise DeclarationError(f"{where} is {value!r}; it must be finite.")
    if np.any(np.abs(array) > LARGEST):
        raise DeclarationError(f"{where} is {short(value)}; its square is infinite: give a realistic value.")
    return array


def misshapen(where: str, value: Any, found: tuple[int, ...], shape: tuple[int, ...], remedy: str = "") -> str:
    """Return the message for a value of a wrong shape; a decimal comma has its own remedy."""
    more = f" {remedy}" if remedy and not decimal_point(value) else ""
    if shape or len(found) > 2:
        wanted = f"have shape {shape}" if shape else "be one number"
        return f"{where} has shape {found}; it must {wanted}.{more}"
    return f"{where} is {short(value)}; it must be one number{decimal_point(value)}.{more}"


def is_symbolic(value: Any) -> bool:
    """Return whether a value is an expression or a condition, or contains one."""
    if _is_listed(value):
        return any(is_symbolic(item) for item in value)
    return isinstance(value, Expr | Condition)


def _written(value: Any) -> str:
    if isinstance(value, InitialValue):
        return shown(value)
    if callable(value):
        return "a function"
    return "a generator" if isinstance(value, Iterator) else repr(value)


def _has_no_number(value: Any) -> bool:
    if _is_listed(value):
        return any(_has_no_number(item) for item in value)
    return value is None or isinstance(value, bool | np.bool_ | str | Symbolic | Condition | ca.SX | ca.MX)


def _is_listed(value: Any) -> bool:
    """Return whether a value may have entries that are not numbers."""
    listed = isinstance(value, np.ndarray) and value.dtype == object and value.ndim > 0
    return isinstance(value, list | tuple) or listed
