"""The stop time that a model declares, and evaluation of settings that depend on parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.errors import DeclarationError
from acausal.flatten.instantiate import Instantiation
from acausal.flatten.origin import Origin, with_place
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.language.pending import PENDING, Pending
from acausal.language.value_checks import shown
from acausal.locks import exclusive
from acausal.symbols import stacked


@exclusive
def own_stop_time(model: Component, values: Mapping[str, Any] | None = None) -> float | None:
    """Return the `stop_time` of a model in s, None if it has none.

    Parameters
    ----------
    model : Component
        Not instantiated. Its `stop_time` is a number, a property, a parameter, structural, or an expression of these.
    values : mapping of str to value, optional
        Values by path that replace those of the model.

    Raises
    ------
    DeclarationError
        If it is not a number of seconds greater than 0.
    """
    cls = type(model)
    declared = getattr(cls, "stop_time", None)
    if isinstance(declared, f.Field | Component) and not isinstance(declared, f.Structural | f.Parameter):
        raise DeclarationError(
            f"`stop_time` of {cls.__name__} is a part or a variable, which has no value before the run; rename it, or give a "
            "stop time: --stop-time 2, or stop_time=2.0."
        )
    value = own_value(model, "stop_time", values)
    return None if value is None else check_stop_time(value, f" of {cls.__name__}")


def own_value(model: Component, name: str, values: Mapping[str, Any] | None = None) -> Any:
    """Return an attribute of a model; an expression of parameters or structural fields is evaluated.

    Parameters
    ----------
    model : Component
        Not instantiated.
    name : str
        Name of the attribute; None is returned if the model has none.
    values : mapping of str to value, optional
        Values by path that replace those of the model.

    Raises
    ------
    DeclarationError
        If it depends on variables, which have no value before the run.
    """
    declared = vars(model).get(name, getattr(type(model), name, None))
    if declared is None:
        return None
    if not isinstance(declared, f.Deferrable | Expr | property):
        return getattr(model, name)
    built = None if model._is_bound else Instantiation(model, values)
    root = built.root if built else model

    def call() -> Any:
        now = PENDING.set(Pending())
        PENDING.get().watches = False  # piecewise() of parameters is evaluated here and makes no switch
        try:
            return getattr(root, name) if isinstance(declared, property) else f.evaluate(declared, root)
        except AttributeError as error:
            if not isinstance(error.obj, Component) or error.name not in error.obj.fields:
                raise
            raise DeclarationError(f"{name} depends on the variable `{error.name}`. {_REMEDY.format(name)}") from None
        finally:
            PENDING.reset(now)

    value = with_place(call, Origin.of(model))
    sx = getattr(value, "sx", None)
    return value if sx is None or built is None else _number(sx, built, name)


def check_stop_time(value: Any, of: str = "") -> float:
    """Return a stop time in s.

    Parameters
    ----------
    value : number
        In s.
    of : str
        Its owner, for the message.
    """
    number = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not number or not np.isfinite(value) or value <= 0:
        what = shown(value, f"a {type(value).__name__.lower()}")
        raise DeclarationError(
            f"stop_time{of} is {what}; it must be a number of seconds greater than 0, such as stop_time = 2.0."
        )
    return float(value)


def _number(sx: ca.SX, built: Instantiation, name: str) -> float:
    """Return the value of a scalar expression of parameters."""
    known = built.parameters
    inputs = {s.element_hash() for s in known.symbols}
    if sx.numel() != 1 or any(s.element_hash() not in inputs for s in ca.symvar(sx)):
        what = "time" if sx.numel() == 1 else f"an array of shape {sx.shape}"
        raise DeclarationError(f"{name} of {type(built.root).__name__} depends on {what}. {_REMEDY.format(name)}")
    function = ca.Function("own", [stacked(known.symbols)], [ca.densify(sx)])
    return float(Call(function)(np.array(known.values))[0][0])


_REMEDY = "Compute it from parameters and structural fields alone, or give a number: {}=..."
