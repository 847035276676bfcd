"""Conversion of quantities of other packages (pint, astropy, unyt) to the unit of a field.

They are recognised by common attributes: a number (`magnitude` or `value`), a unit (`units` or `unit`), and `to(unit)`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.errors import DeclarationError, UnitsError
from acausal.language.unit_rules import Unit
from acausal.units import BASES, Dimension

# Some packages give angles a unit, which SI does not; its powers in moments, stiffnesses and rates:
_ANGLES = ("", "*rad", "/rad", "*rad**2", "/rad**2")


def plain(value: Any, unit: Unit, where: str) -> Any:
    """Return a value with quantities, also in lists and arrays, replaced by numbers in SI.

    Parameters
    ----------
    value : object
        Value from the user.
    unit : Dimension, tuple of Dimension or None
        Unit of the field, or of each of its rows; None if none is declared.
    where : str
        Name of the field, for messages.

    Raises
    ------
    DeclarationError
        If the field has no unit, or the value is a masked array.
    UnitsError
        If a quantity has another dimension.
    """
    if type(value) is float:
        return value
    if isinstance(value, np.ma.MaskedArray):
        raise DeclarationError(f"{where} is {masked(value)}")
    listed = _is_listed(value)
    if not is_quantity(value) and not (listed and _holds_quantity(value)):
        return value
    if isinstance(unit, tuple) and (listed or np.ndim(_number(value))) and len(value) == len(unit):
        return [plain(item, own, where) for item, own in zip(value, unit, strict=True)]
    if listed:
        return [plain(item, unit, where) for item in value]
    if not isinstance(unit, Dimension):
        own = (
            "has several units: give a quantity for each entry" if unit else "has no unit: give the number alone, in SI"
        )
        raise DeclarationError(f"{where} is {_shown(value)}, but the field {own}.")
    return _converted(value, unit, where)


def is_quantity(value: Any) -> bool:
    """Return whether a value is a quantity of another package: a number or an array with a unit."""
    if isinstance(value, int | float | str | type) or not callable(getattr(value, "to", None)):
        return False
    return any(hasattr(value, n) for n in ("magnitude", "value")) and any(hasattr(value, u) for u in ("units", "unit"))


def misplaced_quantity(value: Any) -> str:
    """Return the message for a quantity that belongs to no field with a unit, "" for other values."""
    if isinstance(value, np.ma.MaskedArray):
        return masked(value)
    if not is_quantity(value):
        return ""
    return f'{_shown(value)}, a quantity of another package: write the number in SI with its unit, quantity(1.5, "kg").'


def masked(value: Any) -> str:
    """Return the message for a masked array."""
    hidden = int(np.ma.count_masked(value))
    return f"a masked array ({hidden} of {value.size} entries are masked): give numbers alone, array.filled(value)."


def _converted(value: Any, unit: Dimension, where: str) -> Any:
    for angle in _ANGLES:
        try:
            number = _number(value.to(f"{_text(unit)}{angle}" if _text(unit) else angle.lstrip("*").replace("/", "1/")))
        except Exception:  # packages raise different errors for incompatible units
            continue
        return np.asarray(number, dtype=float) if np.ndim(number) else float(number)
    own = str(unit) if unit.exponents.count(0) < len(BASES) else "a number or an angle"
    raise UnitsError(
        f"{where} is {_shown(value)}, which cannot be converted to {own}. Give a quantity of that dimension, or the "
        "number alone, in SI."
    )


def _number(quantity: Any) -> Any:
    return quantity.magnitude if hasattr(quantity, "magnitude") else quantity.value


def _text(unit: Dimension) -> str:
    """Return a unit in base units, in the syntax of the other packages."""
    powers = zip(BASES, unit.exponents, strict=True)
    return "*".join(base if power == 1 else f"{base}**({power})" for base, power in powers if power)


def _is_listed(value: Any) -> bool:
    return isinstance(value, list | tuple) or (
        isinstance(value, np.ndarray) and value.dtype == object and value.ndim > 0 and not is_quantity(value)
    )


def _holds_quantity(value: Any) -> bool:
    """Return whether a list contains a quantity or a masked array at any depth."""
    return any(
        isinstance(item, np.ma.MaskedArray) or is_quantity(item) or (_is_listed(item) and _holds_quantity(item))
        for item in value
    )


def _shown(value: Any) -> str:
    text = " ".join(str(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
