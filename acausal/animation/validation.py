"""Check the evaluated numbers of a shape."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape
from acausal.errors import DeclarationError

ORTHONORMAL = 1e-6  # largest error of products of unit vectors: rounding, and vectors typed with six or more digits


def check_shape(one: PartShape) -> None:
    """Refuse a shape that cannot be drawn.

    Raises
    ------
    DeclarationError
        If a number is not finite or a length is negative, a direction is zero, or the arrays of a mesh or curve do not match.
    """
    for name, what in _faults(one.shape):
        owner = f"{one.path or 'the model'} ({one.kind})"
        raise DeclarationError(f"`{name}` of the {type(one.shape).__name__} of {owner} {what}.")


def _faults(shape: Any) -> Iterator[tuple[str, str]]:
    """Yield each faulty field and its fault, as the rest of a sentence."""
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
            yield name, "is zero. Give a direction, such as (0, 0, 1)"
    if isinstance(shape, g.Box) and np.abs(shape.axes @ shape.axes.T - np.eye(3)).max() > ORTHONORMAL:
        yield "axes", "are not three orthogonal unit vectors, one in each row"
    if isinstance(shape, g.Curve):
        yield from _curve_faults(shape)
    if isinstance(shape, g.Mesh):
        yield from _mesh_faults(shape)


def _curve_faults(curve: g.Curve) -> Iterator[tuple[str, str]]:
    count = curve.points.shape[1]
    if count < 2:
        yield "points", "needs at least two points"
    if len(curve.section) not in (1, count):
        yield "section", f"has {len(curve.section)} entries for {count} points"
    if curve.up is not None and curve.up.shape[1] not in (1, count):
        yield "up", f"has {curve.up.shape[1]} entries for {count} points"


def _mesh_faults(mesh: g.Mesh) -> Iterator[tuple[str, str]]:
    count, triangles = len(mesh.vertices), np.asarray(mesh.triangles)
    if not np.isfinite(mesh.vertices).all():
        yield "vertices", "has an entry that is not a finite number"
    if count == 0:
        yield "vertices", "is empty"
    if np.any(triangles < 0) or np.any(triangles >= count) or np.any(triangles != np.floor(triangles)):
        yield "triangles", f"contains an index outside 0 to {count - 1}, the rows of `vertices`"
    if (mesh.modes is None) != (mesh.q is None):
        yield "modes", "and `q` must both be given, or neither"
    if mesh.modes is not None and mesh.q is not None:
        wanted = (mesh.q.shape[1], count, 3)
        if np.shape(mesh.modes) != wanted or not np.isfinite(mesh.modes).all():
            yield (
                "modes",
                f"must be finite numbers of shape {wanted}: a displacement of each vertex for each entry of `q`",
            )
