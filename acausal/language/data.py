"""Values that are data: comparison, names of classes, digests for journals, and loading from files."""

from __future__ import annotations

import hashlib
import os
import pickle
from collections.abc import Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from acausal.language.formatting import in_code


def same(a: Any, b: Any) -> bool:
    """Return whether two values are equal; arrays and lists of arrays are compared entry by entry."""
    if a is b:
        return True
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return np.array_equal(a, b)
    if _is_listed(a) and _is_listed(b):
        return len(a) == len(b) and all(map(same, a, b))
    with suppress(ValueError, TypeError):  # truth values of arrays are ambiguous
        return bool(a == b)
    return plain(a) == plain(b)


def _is_listed(value: Any) -> bool:
    return isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.ndim > 0)


def plain(value: Any) -> Any:
    """Return a JSON representation of a value, equal for equal values in every process.

    Data with a short `repr` are represented by it, other data by a digest of their pickle.
    """
    if isinstance(value, np.ndarray | np.generic):  # includes numpy scalars, some of which compare like arrays
        found = value.tolist()
        return repr(found) if isinstance(found, np.generic) else plain(found)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [plain(v) for v in value]
    if text := in_code(repr(value), ""):
        return text
    with suppress(Exception):  # a nested function, or an object with one, cannot be pickled
        return f"{type(value).__qualname__} {hashlib.sha256(pickle.dumps(value)).hexdigest()}"
    return repr(value)


def expected(cls: type, optional: bool) -> str:
    """Return the words for a value of a class in messages, such as "a whole number"."""
    what = {int: "a whole number", float: "a number", str: "a text", bool: "True or False"}.get(cls)
    what = what or f"{'an' if cls.__name__[0] in 'AEIOU' else 'a'} {cls.__name__}"
    if loads(cls):
        what += ", or the name of its file"
    return f"{what}{', or None' if optional else ''}"


def fits(value: Any, cls: type) -> bool:
    """Return whether a value is of a class; True and False are not numbers, and an int is a valid float."""
    if cls in (int, float):
        kinds = (int, np.integer) if cls is int else (int, float, np.integer, np.floating)
        return isinstance(value, kinds) and not isinstance(value, bool)
    return isinstance(value, cls)


def read(value: Any, cls: type) -> Any:
    """Return a value, or the content of the file that it names if the class has `load(path)`."""
    is_name = isinstance(value, str | os.PathLike) and not isinstance(value, cls)
    if not (is_name and loads(cls)):
        return value
    path = Path(value).expanduser()
    try:
        state = path.stat()
    except OSError:
        return cls.load(path)  # type: ignore[attr-defined]  # raises the error with its message
    return _loaded(cls, path.resolve(), state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=8)
def _loaded(cls: Any, path: Path, *state: int) -> Any:
    """Return the content of a file; cached, as a study builds its model many times."""
    return cls.load(path)


def loads(cls: type) -> bool:
    """Return whether a class reads files: it has `load(path)`."""
    return callable(getattr(cls, "load", None))
