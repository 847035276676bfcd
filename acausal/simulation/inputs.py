"""Data and functions of time for the inputs of a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel, checked_values
from acausal.errors import DeclarationError, UnitsError
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.driven import Driven
from acausal.language.expression import Expr
from acausal.language.quantities import plain
from acausal.language.table import Table
from acausal.language.value_checks import shown
from acausal.nearest import suggestions
from acausal.units import parse

EXTRAPOLATIONS = ("refuse", "hold")
NEAR = 1e-9  # of the run: data may end so much before it, as times are rounded


def with_inputs(
    model: Component | CompiledModel,
    parameters: Mapping[str, Any] | None,
    inputs: Mapping[str, Any] | None,
    extrapolation: str = "refuse",
    ends: tuple[float, float] | None = None,
) -> dict[str, Any]:
    """Return values by path, with the laws of inputs among them.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    parameters, inputs, extrapolation
        As in `simulate`.
    ends : (float, float), optional
        Start and stop of the run in s; None if any data will do.

    Raises
    ------
    DeclarationError
        A name is no input or has two values, data are no table, or do not cover the run.
    """
    values, given = checked_values(parameters), checked_values(inputs)
    if extrapolation not in EXTRAPOLATIONS:
        raise DeclarationError(f"extrapolation is {shown(extrapolation)}; it must be refuse or hold.")
    known = {name: d for name, d in _fields(model).items() if isinstance(d, f.Variable) and d.causality == "input"}
    for name, value in given.items():
        if name not in known:
            raise DeclarationError(
                f"`{name}` is no input of the whole model{suggestions(name, list(known))}"
                if known
                else f"`{name}` is no input: the model has none. Declare it in its class: {name}: Scalar = input(...)."
            )
        if name in values:
            raise DeclarationError(f"`{name}` has two values, in inputs and in parameters; leave one out.")
        values[name] = _law(name, value, known[name], extrapolation, ends)
    return values


def at_time(
    model: Component | CompiledModel,
    parameters: Mapping[str, Any] | None,
    inputs: Mapping[str, Any] | None,
    time: float,
) -> dict[str, Any]:
    """Return values by path, with the values of inputs at a time among them; for the arguments see `with_inputs`."""
    values = with_inputs(model, parameters, inputs, "hold")
    for name in inputs or {}:
        law = values[name]
        values[name] = law(time) if isinstance(law, Table) else _number(name, law.function, time)
    return values


def _fields(model: Component | CompiledModel) -> Mapping[str, f.Field]:
    return (model.tree if isinstance(model, CompiledModel) else type(model)).fields


def _law(name: str, value: Any, declared: f.Variable, extrapolation: str, ends: tuple[float, float] | None) -> Any:
    """Return the law of an input: a table, or a function of time."""
    if isinstance(value, Table):
        if len(value.axes) > 1:
            raise DeclarationError(f"input `{name}`: a table of time has one abscissa, not two.")
        return value
    if callable(value) and not isinstance(value, type):
        return Driven(value)
    try:
        found = _table(value, declared, extrapolation)
    except (DeclarationError, UnitsError) as error:
        raise type(error)(f"input `{name}`: {error}") from None
    if found is None:
        raise DeclarationError(
            f"input `{name}` is {shown(value)}; it takes (times, values), a Table, a pandas Series or a function of time; a "
            f"constant is a parameter: parameters={{{name!r}: 1.0}}."
        )
    first, last = found.x[0], found.x[-1]
    if ends is not None and extrapolation == "refuse":
        near = NEAR * (ends[1] - ends[0])
        if first > ends[0] + near or last < ends[1] - near:
            raise DeclarationError(
                f"input `{name}`: its data cover {first:g} s to {last:g} s, the run {ends[0]:g} s to {ends[1]:g} s. "
                'Give more, simulate less, or hold the last value: extrapolation="hold".'
            )
    return found


def _table(value: Any, declared: f.Variable, extrapolation: str) -> Table | None:
    """Return the table of times and values, or of a Series; None for something else."""
    if hasattr(value, "index") and hasattr(value, "to_numpy"):
        return Table.from_pandas(value, kind=_kind(value.to_numpy()))
    if not isinstance(value, tuple | list) or len(value) != 2 or not np.ndim(_plain(value[0], "s")):
        return None
    unit = declared.unit if isinstance(declared.unit, str) else None
    times, values = _plain(value[0], "s"), _plain(value[1], unit)
    return Table(times, values, kind=_kind(values))


def _kind(values: Any) -> str:
    """Return how to interpolate: truth values hold."""
    return "constant" if np.asarray(values).dtype == bool else "linear"


def _plain(values: Any, unit: str | None) -> Any:
    """Return numbers without their unit, which must be that of the input, or for a quantity of its dimension."""
    if not isinstance(values, Expr):
        return plain(values, None if unit is None else parse(unit), "its column of data")
    if not values.sx.is_constant():
        raise DeclarationError("its data are an expression; give numbers.")
    if unit is not None and values.unit is not None and values.unit != parse(unit):
        raise DeclarationError(f"its data are in [{values.unit}], not in [{unit}].")
    return ca.DM(values.sx).full().ravel()


def _number(name: str, function: Callable[[Any], Any], time: float) -> Any:
    value = function(time)
    if isinstance(value, Expr) and value.sx.is_constant():
        value = _plain(value, None).reshape(value.shape)
    if not np.isfinite(np.asarray(value, dtype=float)).all():
        raise DeclarationError(f"input `{name}` is {value!r} at {time:g} s; it must be finite.")
    return value
