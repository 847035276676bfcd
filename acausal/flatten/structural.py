"""Checks of structural parameters: class, choices and bounds."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from acausal.errors import AcausalError, DeclarationError
from acausal.flatten.numeric import is_symbolic, numeric
from acausal.flatten.origin import Origin, with_place
from acausal.language import data
from acausal.language import fields as f
from acausal.language.component import Component
from acausal.language.value_checks import shown_or_kind


def structural_value(bound: Component, declared: f.Structural, given: Any, where: str) -> Any:
    """Return the checked value of a structural parameter.

    Parameters
    ----------
    bound : Component
        Component under construction, with the structural parameters on which bounds depend.
    declared : Structural
        Declaration of the field.
    given : object
        Value from the user; the name of a file is replaced by its content if the class of the field loads files.
    where : str
        Name of the field, for messages.

    Raises
    ------
    DeclarationError
        If the value is invalid for the field.
    """
    value: Any = given.item() if isinstance(given, np.generic) else given
    if is_symbolic(value):
        raise DeclarationError(
            f"{where} is structural, fixed when the model is compiled: it cannot depend on {value!r}, which may change "
            "later. Give numbers, or declare the parameter on which it depends structural(...)."
        )
    if declared.choices is not None:
        shape = declared.shape
        entries = numeric(value, shape, where).flat if isinstance(shape, tuple) else [value]
        if not all(any(_is(entry, c) for c in declared.choices) for entry in entries):
            which = "each entry" if isinstance(shape, tuple) else "it"
            raise DeclarationError(f"{where} is {_written(value)}; {which} must be {one_of(declared.choices)}.")
    if value is None and declared.default is None:
        return None
    if declared.cls is not None:
        value = _of_class(value, declared, where)
    if wrong := _out_of_bounds(value, declared, largest(bound, declared)):
        raise DeclarationError(f"{where} is {_written(value)}; it must be {wrong}.")
    if isinstance(declared.shape, tuple):
        value = numeric(value, declared.shape, where)
    return value


def _out_of_bounds(value: Any, declared: f.Structural, most: float | None) -> str:
    """Return the words for a valid number, "" if the value is valid."""
    least, is_number = declared.minimum, data.fits(value, float)
    if least is not None and not (is_number and value >= least):
        return f"a number of at least {least:g}"
    if type(declared.default) is int and not data.fits(value, int):
        return "a whole number"
    return f"a number of at most {most:g}" if most is not None and not (is_number and value <= most) else ""


def largest(bound: Component, declared: f.Structural) -> float | None:
    """Return the largest allowed value of a structural parameter, or None."""
    most: Any = declared.maximum
    return with_place(lambda: most(bound), Origin.of(bound, f"maximum of {declared.name}")) if callable(most) else most


def one_of(choices: tuple[Any, ...]) -> str:
    """Return the text of the choices for a message."""
    if choices and all(isinstance(c, bool) for c in choices):
        return " or ".join(map(repr, choices))
    return (
        "a function"
        if choices == (callable,)
        else f"one of {', '.join('a function' if c is callable else shown_or_kind(c) for c in choices)}"
    )


def _of_class(value: Any, declared: f.Structural, where: str) -> Any:
    """Return a value of the class of a field, loaded from a file if its name is given."""
    cls: Any = declared.cls
    try:
        found = data.read(value, cls)
    except AcausalError as error:
        raise DeclarationError(f"{where}: {error}") from None
    except (OSError, ValueError, KeyError, EOFError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise DeclarationError(
            f"{where}: {os.fspath(value)!r} contains no {cls.__name__}: {why.rstrip('.')}."
        ) from error
    if not data.fits(found, cls):
        wanted = data.expected(cls, optional=declared.default is None)
        raise DeclarationError(f"{where} is {_written(found)}; it must be {wanted}.")
    return found


def _is(value: Any, choice: Any) -> bool:
    """Return whether a value equals a choice; an array does not, and `callable` stands for any function."""
    if choice is callable:
        return callable(value) and not isinstance(value, type)
    return value is choice or (np.ndim(value) == 0 and data.same(value, choice))


def _written(value: Any) -> str:
    return f"the class {value.__name__}" if isinstance(value, type) else shown_or_kind(value)
