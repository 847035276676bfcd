"""The source of a compiled model, from which unpickling compiles it again."""

from __future__ import annotations

import pickle
import sys
from collections.abc import Callable, Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from acausal.errors import ExportError
from acausal.language.component import Component


class Source(NamedTuple):
    """The arguments of `compile`, and the function itself.

    Parameters
    ----------
    make : callable
        Compiles the model with the parameters.
    model : Component
        The model as constructed.
    parameters : mapping of str to value
        Values by path that replace those of the model.
    """

    make: Callable[..., Any]
    model: Component
    parameters: Mapping[str, Any]


def pickled(source: Source | None) -> tuple[Any, ...]:
    """Return what `__reduce__` of a compiled model returns.

    Parameters
    ----------
    source : Source or None
        What it was compiled from; None if unknown.

    Raises
    ------
    ExportError
        If another process could not import the model's classes.
    """
    if source is None:
        raise ExportError(
            "this compiled model cannot be pickled: it was not made by ac.compile. Write it as an open DAE, which any process "
            "reads: ac.export_dae(compiled, path), ac.load_dae(path)."
        )
    for cls in {type(c) for c in _templates(source.model)}:
        _refuse_hidden(cls)
    try:
        pickle.dumps(source)
    except ExportError:
        raise
    except Exception as error:
        name = type(source.model).__name__
        raise ExportError(
            f"a compiled {name} cannot be pickled, because a value given to the model cannot: {error}. Put functions and "
            f"classes that {name} is given at the top of a module, or compile in each process: ac.compile(...)."
        ) from error
    return source.make, (source.model, source.parameters)


def _templates(value: Any) -> Iterator[Component]:
    """Yield a model before instantiation, and the components passed to it."""
    if isinstance(value, Component):
        yield value
        for given in value._values.values():
            yield from _templates(given)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _templates(item)


def _refuse_hidden(cls: type) -> None:
    """Raise ExportError for a class that another process cannot import."""
    name = cls.__qualname__
    if "<locals>" in name:
        where, remedy = f"inside the function {name.partition('.<locals>')[0]}", "Move it to the top of its module"
    elif cls.__module__ in ("__main__", "__mp_main__"):
        where = "in the script that runs (__main__)"
        remedy = f"Move it to a file of its own, and import it: from {name.lower()} import {name}"
    elif not _importable(cls.__module__):
        file = Path(getattr(sys.modules.get(cls.__module__), "__file__", None) or cls.__module__)
        where, remedy = f"in {file}, which was not imported", f"Import it instead: from {file.stem} import {name}"
    else:
        return
    raise ExportError(
        f"a compiled model with {cls.__name__} cannot be pickled: the class is defined {where}, where another process "
        f"cannot import it. {remedy}. A result can be pickled nevertheless."
    )


def _importable(module: str) -> bool:
    try:
        return find_spec(module) is not None
    except (ImportError, ValueError):
        return False
