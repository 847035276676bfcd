"""What the numbers of a shape must be, once they are known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import Seen
from acausal.errors import DeclarationError

SQUARE = 1e-6  # what products of unit vectors across each other may be: rounding, and digits that were typed


def check(one: Seen) -> None:
    """Refuse a shape that cannot be drawn.

    Raises
    ------
    DeclarationError
        If a fixed number is not finite or negative, a direction has length 0, or the parts of a mesh or curve do not fit.
    """
    for name, what in _wrong(one.shape):
        owner = f"{one.path or 'the model'} ({one.kind})"
        raise DeclarationError(f"`{name}` of the {type(one.shape).__name__} of {owner} {what}.")


def _wrong(shape: Any) -> Iterator[tuple[str, str]]:
    """Yield fields, and what is wrong with them."""
    for name in (
        "up",
        "center",
        "size",
        "axes",
        "start",
        "end",
        "axis",
        "length",
        "diameter",
        "rest_points",
        "section",
    ):
        value = getattr(shape, name, None)
        if value is None or (isinstance(shape, g.Span | g.Curve) and name in ("start", "end", "up")):
            continue
        if not np.isfinite(value).all() and name != "section":
            yield name, "has an entry that is not a finite number"
        if name in ("size", "length", "diameter", "section") and np.any(np.asarray(value) < 0):
            yield name, "is negative"
        if name in ("up", "axis") and not np.any(value):
            yield name, "has length 0; give a direction, such as (0, 0, 1)"
    if isinstance(shape, g.Box) and np.abs(shape.axes @ shape.axes.T - np.eye(3)).max() > SQUARE:
        yield "axes", "are not three unit vectors across each other, a row each"
    if isinstance(shape, g.Curve) and shape.points.shape[1] < 2:
        yield "points", "needs two points or more"
    if isinstance(shape, g.Mesh):
        yield from _wrong_mesh(shape)


def _wrong_mesh(mesh: g.Mesh) -> Iterator[tuple[str, str]]:
    count, triangles = len(mesh.vertices), np.asarray(mesh.triangles)
    if not np.isfinite(mesh.vertices).all():
        yield "vertices", "has an entry that is not a finite number"
    if count == 0:
        yield "vertices", "is empty"
    if np.any(triangles < 0) or np.any(triangles >= count) or np.any(triangles != np.floor(triangles)):
        yield "triangles", f"names other rows than those of its {count} vertices, 0 to {count - 1}"
    if (mesh.modes is None) != (mesh.q is None):
        yield "modes", "and `q` are given together, or neither"
    if mesh.modes is not None and mesh.q is not None:
        wanted = (mesh.q.shape[1], count, 3)
        if np.shape(mesh.modes) != wanted or not np.isfinite(mesh.modes).all():
            yield "modes", f"must be finite numbers of shape {wanted}: for each entry of `q`, for each vertex"
