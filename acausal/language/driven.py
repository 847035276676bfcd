"""Laws of inputs of the whole model: tables and functions of time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from acausal.errors import AcausalError, DeclarationError
from acausal.language import unit_rules
from acausal.language.expression import Expr, as_expr
from acausal.language.fields import Deferred
from acausal.language.formatting import kind_of
from acausal.language.functions import time
from acausal.language.lookup import table
from acausal.language.table import Table


@dataclass(frozen=True)
class Driven:
    """Value of an input of the whole model that varies in a run: a function of time."""

    function: Callable[[Any], Any]


def law_of(given: Table | Driven, name: str, shape: tuple[int, ...], unit: Any) -> Any:
    """Return the value of an input as an expression of time.

    Raises
    ------
    DeclarationError
        The value has another shape than the input, another unit, or is no function of expressions.
    """
    try:
        value = table(time, given.at(name)) if isinstance(given, Table) else given.function(time)
        if isinstance(value, Deferred):
            return value
        value = as_expr(value)
    except AcausalError:
        raise
    except Exception as error:
        raise DeclarationError(
            f"the function of input `{name}` fails for an expression: {type(error).__name__}: {error}. Use the functions of "
            "acausal or numpy in it; or give samples, (times, values)."
        ) from error
    if value.shape != shape:
        raise DeclarationError(f"input `{name}` is {kind_of(value.shape)}; it must be {kind_of(shape)}.")
    own = Expr(value.sx, unit, name, shape)
    unit_rules.check_value(own, value)
    return own
