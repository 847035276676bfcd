"""Checks of the two arguments that every entry point takes: a model, and values by path."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal.compiler.compiled_model import CompiledModel
from acausal.errors import DeclarationError
from acausal.language.component import Component
from acausal.language.expression import Expr
from acausal.language.path import Path
from acausal.language.value_checks import shown_or_kind


def checked_model(given: Any, compiled: bool = False) -> Any:
    """Return the argument if it is a whole model.

    Parameters
    ----------
    given : object
        The argument.
    compiled : bool
        Whether a compiled model is accepted as well.

    Raises
    ------
    DeclarationError
        If it is not a model; the message names the remedy.
    """
    if isinstance(given, CompiledModel):
        if compiled:
            return given
        raise DeclarationError("this model is compiled already; give the model itself, such as SpinUp().")
    if isinstance(given, Component) and not given._is_bound:
        return given
    if isinstance(given, type) and issubclass(given, Component):
        raise DeclarationError(f"{given.__name__} is a class; give an instance of it: {given.__name__}().")
    if isinstance(given, Component) and given._path:
        what = f"`{given._path}` is a part of a built model"
        raise DeclarationError(f"{what}; give the whole model as it was constructed, such as SpinUp().")
    if isinstance(given, Component):
        raise DeclarationError(
            f"this {type(given).__name__} is the `tree` of a compiled model; give the compiled model."
        )
    if isinstance(given, Path):
        raise DeclarationError(f"`{given}` is a part of a model; give the whole model, such as SpinUp().")
    if isinstance(given, str):
        raise DeclarationError(
            f"{given!r} is a text; give a model, such as SpinUp(), imported from where its class is defined "
            "(scenes are run by name on the command line: acausal simulate spin-up)."
        )
    kind = type(given).__name__
    if any(hasattr(type(given), name) for name in ("equations", "connections")):
        raise DeclarationError(f"{kind} is not a model: derive its class from Model, class {kind}(Model).")
    raise DeclarationError(f"a model is an instance such as SpinUp(), not {shown_or_kind(given)}.")


def checked_values(given: Any) -> dict[str, Any]:
    """Return the argument as a dictionary of values by path.

    Parameters
    ----------
    given : object
        A mapping from paths to values, or None.

    Raises
    ------
    DeclarationError
        If it is something else, or a key is not a path.
    """
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise DeclarationError(
            f'parameters is {shown_or_kind(given)}; it must be a dictionary of values by path, such as {{"mass.m": 2.0}}.'
        )
    found = {}
    for key, value in given.items():
        if not isinstance(key, str | Path):
            text = f'"{key.name}"' if isinstance(key, Expr) and key.name else 'such as "mass.m"'
            raise DeclarationError(
                f"{shown_or_kind(key)} is not the path of a parameter; write the path as a text, {text}."
            )
        found[str(key)] = value
    return found
