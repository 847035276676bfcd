"""Simulation settings that a model declares as attributes: defaults of the arguments of `simulate`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler import CompiledModel, checked_model, checked_values
from acausal.compiler.call import Call
from acausal.errors import DeclarationError
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.policy import POLICY
from acausal.simulation.stop_time import check_stop_time, own_stop_time, own_value

DEFAULTS = {
    "stop_time": None,
    "tolerance": None,
    "accuracy": None,
    "intervals": POLICY.defaults.intervals,
    "initial": "fixed",
    "method": "auto",
    "constraints": "auto",
    "max_order": None,
}
COUNTS = ("intervals", "max_order")


def effective_settings(
    model: Component | CompiledModel, values: Mapping[str, Any] | None, given: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the settings of a simulation: the given ones, else those of the model, else the defaults.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    values : mapping of str to value or None
        Values by path that replace those of the model.
    given : mapping of str to value
        Settings by the name of the argument, None if not given.
    """
    own = _declared(model, values)
    found = {name: own(name) if v is None else v for name, v in given.items()}
    # The two exclude each other, and an argument takes precedence over the model.
    for one, other in (("tolerance", "accuracy"), ("accuracy", "tolerance")):
        if given.get(one) is not None and given.get(other) is None:
            found.pop(other, None)
    return {name: DEFAULTS[name] if found.get(name) is None else found[name] for name in given}


def own_setting(model: Component, name: str, values: Mapping[str, Any] | None = None) -> Any:
    """Return a setting that a model declares, None if it declares none.

    Parameters
    ----------
    model : Component
        Not built.
    name : str
        Argument of `simulate`. A plain attribute, a property or an expression of fields declares it; a field of this name is
        not a setting, except a stop time or a method.
    values : mapping of str to value, optional
        Values by path that replace those of the model.
    """
    if name == "stop_time":
        return own_stop_time(model, values)
    declared = getattr(type(model), name, None)
    refers = isinstance(declared, f.Field) and declared.name != name  # tolerance = tol
    field = (
        isinstance(declared, f.Field) and not refers and not (name == "method" and isinstance(declared, f.Structural))
    )
    if field or isinstance(declared, f.Template) or callable(declared):
        return None
    value = own_value(model, name, values)
    if (
        name in COUNTS
        and isinstance(value, float)
        and value.is_integer()
        and isinstance(declared, f.Deferrable | property)
    ):
        return int(value)  # parameters are floating-point numbers
    return None if name == "initial" and not isinstance(value, str) else value  # a number is a constant of the user


def check_number(name: str, value: Any) -> None:
    """Raise DeclarationError if a setting is not a finite number.

    Parameters
    ----------
    name : str
        Name of the setting.
    value : object
        Its value.
    """
    if isinstance(value, Expr):
        if not (value.sx.is_constant() and not value.shape):
            raise DeclarationError(f"{name} is {value!r}, an expression; give a number.")
        unit = ", in s" if "time" in name else ""
        raise DeclarationError(f"{name} is a quantity; give the number alone{unit}: {name}={value!r}.")
    if isinstance(value, bool) or not isinstance(value, int | float | np.number):
        raise DeclarationError(f"{name} is {value!r}; it must be a number.")
    if not np.isfinite(value):
        raise DeclarationError(f"{name} is {value!r}; it must be finite.")


def declared_settings(compiled: CompiledModel) -> dict[str, Any]:
    """Return the settings of a compiled model as numbers, texts, or expressions of its free parameters."""
    if compiled.source is None:
        return dict(compiled.declared or {})
    found = {}
    for name in DEFAULTS:
        value = own_setting(compiled.source.model, name, compiled.source.parameters)
        if value is not None:
            follows = own_value(compiled.tree, name)
            varies = isinstance(follows, Expr) and not follows.sx.is_constant()
            found[name] = follows if varies else value
    return found


def _declared(model: Component | CompiledModel, values: Mapping[str, Any] | None) -> Callable[[str], Any]:
    """Return a function from the name of a setting to the model's own value, given values by path."""
    model, values = checked_model(model, compiled=True), checked_values(values)
    if not isinstance(model, CompiledModel):
        return lambda name: own_setting(model, name, values)
    if model.source is None:
        return lambda name: _value(model, name, values)
    source, values = model.source.model, {**model.source.parameters, **values}
    return lambda name: own_setting(source, name, values)


def _value(compiled: CompiledModel, name: str, values: Mapping[str, Any]) -> Any:
    """Return a setting of a model without a source."""
    value = (compiled.declared or {}).get(name)
    if not isinstance(value, Expr):
        return value
    function = ca.Function("own", [compiled.reduced.p], [ca.densify(value.sx)])
    number = float(Call(function)(compiled.parameter_values(values))[0][0])
    if name == "stop_time":
        return check_stop_time(number, f" of {type(compiled.tree).__name__}")
    return int(number) if name in COUNTS and number.is_integer() else number
