"""Annotations of fields: Scalar, Vector3, Matrix33. To a type checker they are anything that numbers can become."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    Scalar = Any
    Vector3 = Any
    Matrix33 = Any
else:

    class Scalar:
        """A number: shape ()."""

    class Vector3:
        """A vector of three components: shape (3,)."""

    class Matrix33:
        """A 3 x 3 matrix: shape (3, 3)."""


_BY_NAME = {"Scalar": (), "Vector3": (3,), "Matrix33": (3, 3)}


def shape_of_annotation(cls: type, name: str) -> tuple[int, ...] | None:
    """Return the shape that the annotation of a field tells, or None."""
    annotation = inspect.get_annotations(cls).get(name)
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", "")
    return _BY_NAME.get(text.rsplit(".", 1)[-1])
