"""Annotations of fields: Scalar, Vector3 and Matrix33; Any for type checkers."""

from __future__ import annotations

import builtins
import inspect
import re
import sys
from typing import TYPE_CHECKING, Any

from acausal.language.call_arguments import declaration_error
from acausal.nearest import most_similar

if TYPE_CHECKING:
    Scalar = Any
    Vector3 = Any
    Matrix33 = Any
else:

    class _Type:
        def __new__(cls, *_: Any, **__: Any) -> Any:
            name = cls.__name__
            raise declaration_error(
                f'{name} is the type of a field and takes no value: `x: {name} = variable("...")`, or parameter(...).'
            )

    class Scalar(_Type):
        """A number: shape ()."""

    class Vector3(_Type):
        """A vector of three components: shape (3,)."""

    class Matrix33(_Type):
        """A 3 x 3 matrix: shape (3, 3)."""


_BY_NAME = {"Scalar": (), "Vector3": (3,), "Matrix33": (3, 3)}
_NO_TYPES = (tuple, list, int, float)
_READABLE = re.compile(r"[\s('\"]*[^\W\d][\w.]*\s*(\[|\||['\")]|$)")  # a type name, subscripted, in a union or quoted
_REAL = ("float", "float64", "floating", "Real")
_WHOLE = ("int", "bool", "str", "Literal", "Enum")
_LISTED = ("list", "tuple", "ndarray", "Sequence", "Iterable", "array")
_NEITHER = ("dict", "set", "complex", "Mapping", "None", "NoneType", "type", "object")


def shape_of_annotation(cls: type, name: str) -> tuple[int, ...] | None:
    """Return the shape from the annotation of a field, or None."""
    return _BY_NAME.get(_type_name(cls, name))


def wrong_type(cls: type, name: str, shape: object, field: str) -> str:
    """Return the message for an invalid annotation of a parameter or variable, "" for a valid one.

    Parameters
    ----------
    cls : Component class
        Class of the field.
    name : str
        Name of the field.
    shape : tuple of int or callable, optional
        Declared shape.
    field : str
        Name of the function that declares it.
    """
    annotation = inspect.get_annotations(cls).get(name)
    if isinstance(annotation, _NO_TYPES) or (isinstance(annotation, str) and not _READABLE.match(annotation)):
        form = f"{name}: Scalar = {field}(...)"
        if isinstance(annotation, tuple):
            form = f"{name} = {field}(..., shape={annotation!r})"
        elif isinstance(annotation, str):
            form = f"{name}: Scalar = {field}(...)`, where a unit is `unit=..."
        return f"{annotation!r} is not a type: write `{form}`."
    kind = _type_name(cls, name)
    a = "an" if field in ("input", "output") else "a"
    if kind in _REAL:
        listed = shape not in (None, ())
        return f"{kind} is one number; with shape={shape} remove the type, `{name} = {field}(...)`." if listed else ""
    if kind in _WHOLE:
        remedy = f"`{name}: {kind} = structural(...)`"
        return f"{a} {field} is a real number, not {kind}: write `{name}: Scalar`; a count, switch or word is {remedy}."
    if kind in _LISTED:
        remedy = f"`{name}: Vector3`, `{name}: Matrix33`, or give shape=(n,)"
        return f"the type {kind} does not determine the number of entries: write {remedy}." if shape is None else ""
    if kind in _NEITHER or _is_component(cls, kind):
        what = (
            "" if kind in _NEITHER else f"; declare a part by `{name} = {kind}(...)`, a port by `{name} = port({kind})`"
        )
        return f"{a} {field} is a number or an array, not {kind}: write `{name}: Scalar`{what}."
    known = not kind.isidentifier() or kind in _BY_NAME or hasattr(builtins, kind) or kind in _names(cls)
    near = "" if known else most_similar(kind, _BY_NAME)
    return f"the type {kind} is unknown; did you mean {near}?" if near else ""


def _type_name(cls: type, name: str) -> str:
    """Return the type name in the annotation of a field, `list` for list[float]; aliases are resolved."""
    annotation = inspect.get_annotations(cls).get(name)
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", "")
    text = text.partition("[")[0].rsplit(".", 1)[-1].strip()
    alias = None if text in _BY_NAME else _names(cls).get(text)
    return alias.__name__ if isinstance(alias, type) and alias.__module__ == __name__ else text


def _is_component(cls: type, name: str) -> bool:
    found = _names(cls).get(name)
    return isinstance(found, type) and hasattr(found, "_own_fields")


def _names(cls: type) -> dict[str, Any]:
    """Return the names in the module of a class."""
    return vars(sys.modules[cls.__module__]) if cls.__module__ in sys.modules else {}
