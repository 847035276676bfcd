"""Checks of the arguments of studies, before anything is run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from acausal.compiler import CompiledModel
from acausal.errors import DeclarationError
from acausal.language.component import Component
from acausal.language.fields import Field
from acausal.language.value_checks import shown
from acausal.result.lookup import find, match
from acausal.simulation.settings_checks import check_intervals
from acausal.simulation.stop_time import check_stop_time, own_stop_time


def stop_time_of(model: Component, given: float | None, values: Mapping[str, Any]) -> float:
    """Return the given stop time, or that of the model, in s.

    Parameters
    ----------
    model : Component
        The model, which may declare `stop_time`.
    given : float, optional
        In s.
    values : mapping of str to value
        Values by path that replace those of the model.
    """
    own = own_stop_time(model, values) if given is None else given
    if own is None:
        raise DeclarationError(f"{type(model).__name__} declares no stop_time; give one: stop_time=2.0.")
    return check_stop_time(own)


def outputs_of(compiled: CompiledModel, patterns: Sequence[str]) -> tuple[str, ...]:
    """Return the names of the compared scalars; arrays entry by entry.

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    patterns : sequence of str
        Paths, with * and ?; if empty, those in the model's attribute `compared`, or else its outputs.
    """
    requested = items("outputs", patterns, '["x", "y"]')
    own = getattr(type(compiled.tree), "compared", ())
    if not requested and not isinstance(own, Field):
        requested = items("the attribute `compared` of the model", own, '("x", "y")')
    paths = match(compiled.tree, requested) or compiled.outputs
    found = tuple(name for path in paths for _, name, _ in find(compiled.tree, path).entries)
    if not found:
        raise DeclarationError(
            f"{type(compiled.tree).__name__} has no outputs to compare; name variables, for instance "
            f"outputs=[{next(iter(compiled.states), 'joint.phi')!r}]."
        )
    return found


def items(name: str, given: Any, example: str) -> tuple[Any, ...]:
    """Return the items of a list argument; raise DeclarationError if it is not a list.

    Parameters
    ----------
    name : str
        Name of the argument.
    given : object
        Its value.
    example : str
        A valid value, for the message.
    """
    if isinstance(given, str | Mapping) or not isinstance(given, Iterable):
        raise DeclarationError(f"{name} is {shown(given)}; it must be a list, such as {name}={example}.")
    return tuple(given)


def table_of(name: str, given: Any, example: str) -> dict[str, Any]:
    """Return a dictionary argument; raise DeclarationError if it is not a dictionary with names as keys.

    Parameters
    ----------
    name : str
        Name of the argument.
    given : object
        Its value; None means empty.
    example : str
        A valid value, for the message.
    """
    if given is not None and not (isinstance(given, Mapping) and all(isinstance(key, str) for key in given)):
        raise DeclarationError(f"{name} is {shown(given)}; it must be a dictionary, such as {name}={example}.")
    return dict(given or {})


def check_run(intervals: int, repeats: int, limit: float) -> None:
    """Raise DeclarationError for invalid numbers of intervals or repeats, or an invalid limit.

    Parameters
    ----------
    intervals, repeats : int
        At least 1.
    limit : float
        In s.
    """
    check_counts(intervals=intervals, repeats=repeats)
    check_intervals(intervals)
    if isinstance(limit, bool) or not isinstance(limit, int | float) or not limit > 0:
        raise DeclarationError(f"limit is {limit!r}; it must be a number of seconds greater than 0.")


def check_counts(least: int = 1, **counts: Any) -> None:
    """Raise DeclarationError if a value is not a whole number of at least `least`.

    Parameters
    ----------
    least : int
        The smallest allowed value.
    **counts : object
        Values by the name of the argument.
    """
    for name, value in counts.items():
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise DeclarationError(f"{name} is {value!r}; it must be a whole number of at least {least}.")


def check_shares(example: float, **shares: Any) -> None:
    """Raise DeclarationError if a value is not a number between 0 and 1.

    Parameters
    ----------
    example : float
        A valid value, for the message.
    **shares : object
        Values by the name of the argument.
    """
    for name, value in shares.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not 0 < value < 1:
            raise DeclarationError(f"{name} is {value!r}; it must lie between 0 and 1, for instance {example:g}.")
