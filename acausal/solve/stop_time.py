"""The stop time that a model tells of itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.errors import DeclarationError
from acausal.flatten.instantiate import Instantiation
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.locks import alone


@alone
def own_stop_time(model: Component, values: Mapping[str, Any] | None = None) -> float | None:
    """Return the `stop_time` of a model in s, None where it has none.

    Parameters
    ----------
    model : Component
        Not built; `stop_time` is a number in the class, a property, a parameter or structural.
    values : mapping of str to value, optional
        Values by path that replace those of the model.

    Raises
    ------
    DeclarationError
        If it is no number of seconds greater than 0.
    """
    cls = type(model)
    declared = getattr(cls, "stop_time", None)
    if isinstance(declared, f.Structural | f.Parameter | property):
        value = _number(Instantiation(model, values))
    elif isinstance(declared, f.Field | Component):
        raise DeclarationError(
            f"`stop_time` of {cls.__name__} is no number before it runs, but a part or a variable; rename it, or give a "
            "stop time: --stop-time 2, or stop_time=2.0."
        )
    else:
        value = getattr(model, "stop_time", None)
    return None if value is None else check_stop_time(value, f" of {cls.__name__}")


def check_stop_time(value: Any, of: str = "") -> float:
    """Return a stop time in s.

    Parameters
    ----------
    value : number
        In s.
    of : str
        Whose it is, for the message.
    """
    number = isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)
    if not number or not np.isfinite(value) or value <= 0:
        raise DeclarationError(
            f"stop_time{of} is {value!r}; it must be a number of seconds greater than 0, such as stop_time = 2.0."
        )
    return float(value)


def _number(built: Instantiation) -> Any:
    value = getattr(built.root, "stop_time", None)
    sx = getattr(value, "sx", None)
    if sx is None or sx.numel() != 1:
        return value
    known = built.parameters
    function = ca.Function("stop", [ca.vertcat(ca.SX(0, 1), *known.symbols)], [ca.densify(sx)])
    return float(Call(function)(np.array(known.values))[0][0])
