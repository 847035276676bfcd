"""Event statements: `yield when(condition, reinit(variable, value), call(function, arguments, results), ...)`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from acausal.errors import DeclarationError
from acausal.language.call_arguments import checked_call
from acausal.language.condition import Condition
from acausal.language.expression import Equation, Expr, as_expr, equation


@dataclass(frozen=True)
class Reinit:
    """A variable and its value after an event."""

    variable: Expr
    value: Expr


@dataclass(frozen=True)
class Call:
    """A function, its arguments, and discrete variables: its results, and those that take them over at the next event."""

    function: Callable[..., Any]
    arguments: tuple[Expr, ...]
    results: tuple[Expr, ...]
    outputs: tuple[Expr, ...]


@dataclass(frozen=True)
class When:
    """Jumps of variables and calls of functions when a condition becomes true."""

    condition: Condition
    jumps: tuple[Reinit, ...]
    at_start: bool
    calls: tuple[Call, ...] = ()


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
def call(function: Callable[..., Any], arguments: Sequence[Any], results: Sequence[Any], outputs: Any = None) -> Call:
    """State the call of a function at an event, inside when().

    Parameters
    ----------
    function : callable
        Called as function(time, *arguments), with numbers and arrays; returns one value, or a tuple of values for several
        results. What it keeps lives in its object, of which each run takes a copy and calls `reset()`, if it has that. At an
        instant it is called once; with an attribute `pure` that is true, in each iteration of the event.
    arguments : sequence of Expr
        Values just before the event, except for the results of other functions that are called at it: those are new.
    results : sequence of Expr
        Discrete variables.
    outputs : sequence of Expr, optional
        Discrete variables, one for each result, that take it over at the next event.
    """
    taken = results if outputs is None else outputs
    if not callable(function):
        raise DeclarationError(f"call needs a function first, such as call(f, (self.u,), (self.y,)), not {function!r}.")
    if len(taken) != len(results):
        raise DeclarationError(f"call has {len(results)} results, and {len(taken)} outputs; they must be as many.")
    return Call(function, tuple(map(as_expr, arguments)), tuple(results), tuple(taken))


@checked_call
def when(condition: Any, *actions: Reinit | Call, at_start: bool = False) -> When:
    """State what happens at each event at which a condition becomes true; yield it in equations().

    Parameters
    ----------
    condition : Condition
        Comparison of two scalars, such as self.h < 0.
    *actions : reinit(...), call(...)
        Jumps, all computed from the values just before the event, and calls of functions.
    at_start : bool
        True if they also take place at the start, if the condition holds there.

    Notes
    -----
    A condition that becomes true just after the start acts at the start. One that becomes true at the stop time has acted
    there; one that becomes true just after it is left to a run that starts there.

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
    jumps = tuple(action for action in actions if isinstance(action, Reinit))
    calls = tuple(action for action in actions if isinstance(action, Call))
    if not actions or len(jumps) + len(calls) < len(actions):
        listed = " Give them without a list." if any(isinstance(action, list | tuple) for action in actions) else ""
        raise DeclarationError(
            f"when needs one or more reinit(variable, value) after its condition, such as {form}.{listed}"
        )
    return When(condition, jumps, at_start, calls)
