"""Interface of an FMU: its inputs, outputs and parameters as fields of a component."""

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


@dataclass(frozen=True)
class Interface:
    """What is read of an FMU: its path, version, default step in s, and signals."""

    path: str
    version: str
    step: float | None
    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]
    parameters: tuple[Signal, ...]


def read_interface(path: str | os.PathLike[str], taken: Collection[str]) -> Interface:
    """Read the interface of an FMU for Co-Simulation; fields avoid names that are taken.

    Raises
    ------
    DeclarationError
        The file is no FMU, or lacks Co-Simulation, or an input or output is not a scalar number.
    """
    from fmpy import read_model_description

    path = os.path.abspath(path)
    if not os.path.isfile(path):
        raise DeclarationError(f"there is no FMU {os.fspath(path)!r}.")
    try:
        found = read_model_description(path, validate=False)
    except Exception as error:
        raise DeclarationError(f"{os.path.basename(path)!r} is no FMU: {error}.") from error
    if found.fmiVersion not in TYPES or found.coSimulation is None:
        own = f"FMI {found.fmiVersion}" + ", Model Exchange alone" * (found.coSimulation is None)
        raise DeclarationError(f"{os.path.basename(path)!r} is {own}; it must be for Co-Simulation by FMI 2 or 3.")
    wanted = {"input": list[Signal](), "output": list[Signal](), "parameter": list[Signal]()}
    units = {str(unit.name): unit.baseUnit for unit in found.unitDefinitions}
    for variable in found.modelVariables:
        if variable.causality in wanted and (signal := _signal(variable, found.fmiVersion, units, path, taken)):
            wanted[variable.causality].append(signal)
    experiment = found.defaultExperiment
    step = float(experiment.stepSize) if experiment is not None and experiment.stepSize else None
    return Interface(path, found.fmiVersion, step, *(tuple(wanted[kind]) for kind in ("input", "output", "parameter")))


def _signal(variable: Any, version: str, units: dict[str, Any], path: str, taken: Collection[str]) -> Signal | None:
    """Return a variable; None for a parameter that is no scalar number, and keeps its value."""
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
        field, variable.name, variable.valueReference, kind, unit, text, factor * start + offset, factor, offset
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
