"""Event statements: `yield when(condition, reinit(variable, value), ...)`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition
from acausal.language.expression import Equation, Expr, equation


@dataclass(frozen=True)
class Reinit:
    """A variable and its value after an event."""

    variable: Expr
    value: Expr


@dataclass(frozen=True)
class When:
    """Jumps of variables when a condition becomes true."""

    condition: Condition
    jumps: tuple[Reinit, ...]
    at_start: bool


@checked_call
def reinit(variable: Any, value: Any) -> Reinit:
    """State the value of a variable after an event, inside when().

    Parameters
    ----------
    variable : Expr
        A state or a discrete variable.
    value : float or Expr
        New value, computed from the values just before the event.
    """
    if not isinstance(variable, Expr) or not variable.name:
        raise DeclarationError(
            f"reinit needs a variable before its value, such as reinit(self.v, 0), not {variable!r}."
        )
    same: Equation = equation(variable, value)
    return Reinit(same.lhs, same.rhs)


@checked_call
def when(condition: Any, *jumps: Reinit, at_start: bool = False) -> When:
    """State the jumps at each event at which a condition becomes true; yield it in equations().

    Parameters
    ----------
    condition : Condition
        Comparison of two scalars, such as self.h < 0.
    *jumps : reinit(...)
        Jumps, all computed from the values just before the event.
    at_start : bool
        True if the jumps also take place at the start, if the condition holds there.

    Examples
    --------
    >>> yield when(self.h < 0, reinit(self.v, -self.e * self.v))  # doctest: +SKIP
    """
    form = "when(self.h < 0, reinit(self.v, 0))"
    if not isinstance(condition, Condition) or condition.excess.shape:
        late = f" For a fixed time write time >= {condition:g}." if type(condition) in (int, float) else ""
        order = " The condition comes first." if isinstance(condition, Reinit) else ""
        raise DeclarationError(
            f"when needs a condition that compares two scalars by <, <=, > or >=, such as {form}.{late}{order}"
        )
    if not jumps or not all(isinstance(jump, Reinit) for jump in jumps):
        listed = " Give them without a list." if any(isinstance(jump, list | tuple) for jump in jumps) else ""
        raise DeclarationError(
            f"when needs one or more reinit(variable, value) after its condition, such as {form}.{listed}"
        )
    return When(condition, jumps, at_start)
