"""Conversion of the objects of a model to JSON data and back, by lists of the fields of each class."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import casadi as ca
import numpy as np

from acausal.errors import ExportError
from acausal.flatten.discontinuities import Guard, Jump, Law, Promise
from acausal.flatten.flat_model import (
    FlatClosure,
    FlatDiscontinuities,
    FlatEquations,
    FlatLoops,
    FlatModel,
    FlatParameters,
    FlatUnknowns,
    Initial,
    Loop,
)
from acausal.flatten.origin import Origin
from acausal.language import fields as f
from acausal.language.condition import Condition, Joined
from acausal.language.expression import Expr
from acausal.language.table import Table
from acausal.language.validity_statements import Expectation, Requirement, Separation
from acausal.reduce import ReducedModel
from acausal.reduce.constrain import Projections
from acausal.structure import Plan
from acausal.structure.block import Block
from acausal.structure.coordinate_projection import Constrained, Constraint, Projection
from acausal.structure.system import System
from acausal.units import BASES, Dimension

# Omitted fields: `eliminated_by` and `repeats`, which serve messages about models that do not compile; `zero_block`; `tree`,
# which is written separately.
FIELDS: dict[type, str] = {
    Origin: "path kind where text",
    Initial: "residual text origin",
    FlatClosure: "row dual loop statement",
    Loop: "a b where parts constraints dropped undetermined kind",
    FlatUnknowns: "symbols names derivative declared preference nominal sized units start guessed eliminated",
    FlatEquations: "residuals origins defines initial redundant",
    FlatParameters: "symbols names values weighing limits bound defaults structural_zeros tables raised",
    FlatDiscontinuities: "switches guards discretes continuous promises laws kinks",
    FlatLoops: "cuts closures folded",
    FlatModel: "unknowns equations parameters discontinuities loops energies unconnected counts stays_zero",
    Guard: "condition origin jumps at_start",
    Jump: "target value discrete",
    Law: "speed rate limit places origin",
    Promise: "excess step value compared inclusive origin",
    Plan: "system differentiated created states blocks algebraic residuals assigned observed constrained",
    System: "rows explicit derivative declared defines preference monic closures",
    Block: "equations variables",
    Constrained: "constraints projections reached following",
    Constraint: "base rows multipliers top",
    Projection: "coordinate rate state state_rate multipliers",
    Projections: "constraints choice coordinates states following moves",
    ReducedModel: "flat plan unknowns names x z ode alg definitions projections continuous residuals kinks",
    Condition: "excess kind",
    Joined: "a b every",
    Expr: "sx unit name shape",
    Requirement: "subject problem",
    Expectation: "part whole share text",
    Separation: "offset rate effect text",
    f.Parameter: "description minimum positive",
    f.InitialValue: "value fixed",
    Table: "x values kind extrapolation ends",
}
_CLASS = {cls.__name__: cls for cls in FIELDS}
_FILES = {Origin: "where", Loop: "where"}


def encoded(value: Any, add: Callable[[ca.SX | ca.DM], int]) -> Any:
    """Return a value as JSON data.

    Parameters
    ----------
    value : object
        Numbers, text, containers, arrays, expressions, units and the classes of `FIELDS`.
    add : callable
        Function from an expression to its number.
    """
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, np.bool_ | np.integer | np.floating):
        value = value.item()
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        return value if np.isfinite(value) else {"number": repr(value)}
    if isinstance(value, ca.SX | ca.DM):  # an empty CasADi expression may be a DM
        return {"expression": add(value)}
    if isinstance(value, np.ndarray) and value.ndim:
        return {"array": value.dtype.kind, "entries": [encoded(v, add) for v in value.tolist()]}
    if isinstance(value, tuple):
        return [encoded(v, add) for v in value]
    if isinstance(value, list):
        return {"list": [encoded(v, add) for v in value]}
    if isinstance(value, frozenset):
        return {"set": sorted(value)}
    if isinstance(value, Mapping):
        return {"pairs": [[encoded(k, add), encoded(v, add)] for k, v in value.items()]}
    if isinstance(value, Dimension):
        return {"unit": [int(e) if e == int(e) else str(e) for e in value.exponents]}
    if type(value) not in FIELDS:
        raise ExportError(f"an open DAE cannot represent a value of the model: {value!r}.")
    found = {name: encoded(getattr(value, name), add) for name in FIELDS[type(value)].split()}
    if type(value) in _FILES:
        found["where"] = without_folder(found["where"])
    return {"is": type(value).__name__, **found}


def decoded(data: Any, expressions: Any, more: Mapping[str, dict[str, Any]]) -> Any:
    """Return a value from its JSON data.

    Parameters
    ----------
    data : object
        From `encoded`.
    expressions : Reader
        Expressions by their numbers.
    more : mapping of str to dict
        Values of omitted fields, by the name of their class.

    Raises
    ------
    ValueError, KeyError, TypeError
        If the data is invalid.
    """

    def again(inner: Any) -> Any:
        return decoded(inner, expressions, more)

    if isinstance(data, list):
        return tuple([again(v) for v in data])
    if not isinstance(data, dict):
        return data
    if "is" in data:
        cls = _CLASS[data["is"]]
        found = {name: again(data[name]) for name in FIELDS[cls].split()}
        return cls(**found, **more.get(data["is"], {}))
    if "expression" in data:
        return expressions[data["expression"]]
    if "number" in data:
        return float(data["number"])
    if "array" in data:
        return np.array([again(v) for v in data["entries"]], dtype={"f": float, "b": bool, "i": int}[data["array"]])
    if "list" in data:
        return [again(v) for v in data["list"]]
    if "set" in data:
        return frozenset(data["set"])
    if "pairs" in data:
        return {again(k): again(v) for k, v in data["pairs"]}
    exponents = [Fraction(e) if isinstance(e, str) else int(e) for e in data["unit"]]
    if len(exponents) != len(BASES):
        raise ValueError("a unit is invalid")
    return Dimension(*exponents)


def without_folder(where: str) -> str:
    """Return a place "file:line" without folders, which are specific to a machine."""
    return where.replace("\\", "/").rpartition("/")[2]
