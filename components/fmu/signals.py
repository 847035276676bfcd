"""Scalar variables of an FMU as fields of a component."""

from __future__ import annotations

import os
import re
from collections.abc import Collection
from dataclasses import dataclass
from keyword import iskeyword
from typing import Any

from acausal import DeclarationError
from acausal.units import parse

TYPES = {
    "2.0": {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"},
    "3.0": {
        **{name: name for name in ("Float64", "Float32", "Int64", "Int32", "Int16", "Int8", "Boolean")},
        **{name: name for name in ("UInt64", "UInt32", "UInt16", "UInt8")},
        "Enumeration": "Int64",
    },
}
BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
CONTINUOUS = ("Real", "Float64", "Float32")


@dataclass(frozen=True)
class Signal:
    """A scalar variable of an FMU; its value in SI is factor * value + offset.

    Attributes
    ----------
    field : str
        Name of the field.
    name : str
        Name in the FMU.
    reference : int
        Value reference.
    kind : str
        Type, as in the names of the functions of FMI.
    unit, description : str
        SI unit, and what it is.
    start : float
        Start value in SI.
    factor, offset : float
        Of the unit.
    nominal : float
        Nominal value, in the unit of the FMU.
    continuous : bool
        Whether it is a real number that may change at any time.
    """

    field: str
    name: str
    reference: int
    kind: str
    unit: str
    description: str
    start: float
    factor: float
    offset: float
    nominal: float
    continuous: bool

    @property
    def raw(self) -> float:
        """Start value in the unit of the FMU."""
        return (self.start - self.offset) / self.factor


def read_signal(variable: Any, version: str, units: dict[str, Any], path: str, taken: Collection[str]) -> Signal | None:
    """Return a variable, whose field avoids taken names; None for a parameter that is no scalar number, and keeps its value."""
    kind = TYPES[version].get(variable.type)
    if kind is None or variable.dimensions:
        if variable.causality == "parameter":
            return None
        what = "an array" if variable.dimensions else f"of type {variable.type}"
        raise DeclarationError(
            f"`{variable.name}` of {os.path.basename(path)!r} is {what}; inputs and outputs must be scalar numbers."
        )
    unit, factor, offset = _unit(variable.unit or getattr(variable.declaredType, "unit", None), units)
    start = _number(variable.start)
    field = re.sub(r"\W+", "_", variable.name).strip("_")
    field += "_" * (field in taken or iskeyword(field))
    text = re.sub(r"\s+", " ", variable.description or variable.name)
    return Signal(
        *(field, variable.name, variable.valueReference, kind, unit, text, factor * start + offset, factor, offset),
        _number(variable.nominal or 1),
        kind in ("Real", "Float64") and variable.variability in (None, "continuous"),
    )


def _unit(name: str | None, units: dict[str, Any]) -> tuple[str, float, float]:
    """Return the SI unit, factor and offset of a unit of the FMU; no unit where it does not tell."""
    base = units.get(name or "")
    if base is not None:
        powers = [(unit, getattr(base, unit)) for unit in BASE]
        text = ".".join(unit + str(power) * (power != 1) for unit, power in powers if power)
        return text or "1", float(base.factor), float(base.offset)
    try:
        return str(parse(name or "1")), 1.0, 0.0
    except DeclarationError:
        return "1", 1.0, 0.0


def _number(start: Any) -> float:
    if isinstance(start, str) and start.lower() in ("true", "false"):
        return float(start.lower() == "true")
    return float(start or 0)
