"""Evaluate the expressions in shapes, all in one call."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape
from acausal.errors import DeclarationError, caution
from acausal.language.expression import as_expr
from acausal.symbols import dense, stacked, vec

Evaluate = Callable[[Any], np.ndarray]
# Array shapes of the fields that vary with time and of those that do not. None stands for any length; ... too, and for
# one entry without this dimension.
Size = tuple[Any, ...]
MOVING: dict[type, dict[str, Size]] = {
    g.Pose: {"r": (3,), "T": (3, 3)},
    g.Span: {"start": (3,), "end": (3,)},
    g.Rail: {"to": (3,)},
    g.Trail: {"at": (3,)},
    g.Arrow: {"at": (3,), "vector": (3,)},
    g.Curve: {"points": (None, 3), "tangents": (None, 3), "up": (..., 3)},
    g.Values: {"entries": (None,)},
    g.Mesh: {"q": (None,)},
}
FIXED: dict[type, dict[str, Size]] = {
    g.Ground: {"up": (3,)},
    g.Box: {"size": (3,), "axes": (3, 3)},
    g.Cylinder: {"start": (3,), "end": (3,), "diameter": ()},
    g.Sphere: {"diameter": ()},
    g.Axle: {"axis": (3,), "length": (), "diameter": ()},
    g.Rail: {"axis": (3,)},
    g.Span: {"diameter": ()},
    g.Curve: {"section": (..., 2), "rest_points": (None, 3)},
    g.Mesh: {"vertices": (None, 3), "triangles": (None, 3), "modes": (None, None, 3)},
}
# Points that may vary although the shape is rigid: their motion is added to that of the pose.
CARRIED: dict[type, dict[str, Size]] = {g.Box: {"center": (3,)}, g.Sphere: {"center": (3,)}}
# Evaluated numbers are constant if they vary by less than this fraction of the largest one: round-off.
CONSTANT = 1e-9


def evaluate_shapes(
    seen: Sequence[PartShape], more: Iterable[Any], evaluate: Evaluate, time: np.ndarray
) -> tuple[list[PartShape], list[np.ndarray]]:
    """Return the shapes with arrays in place of expressions, and further scalars over time.

    Arrays that vary with time have the shape (times, ...). None stays None, but becomes NaN in a section. `section` and `up`
    of a curve have one entry or one for each point.

    Parameters
    ----------
    seen : sequence of PartShape
        From `collect`, with the entries of all `Values` evaluated.
    more : iterable of casadi.SX, shape (1, 1)
        Further scalars.
    evaluate : callable
        Maps a column of n expressions in the model's symbols to an array of shape (times, n).
    time : array, shape (times,)
        In s.

    Raises
    ------
    DeclarationError
        If a field has the wrong array shape, or varies although it must be constant.
    """
    collector = _Collector()
    for one in seen:
        _mapped(one.shape, one, collector)
    scalars = [collector.column(expression) for expression in more]
    results = _Results(collector, evaluate, time)
    return [replace(one, shape=_mapped(one.shape, one, results)) for one in seen], [
        results.values[:, at].reshape(len(time)) for at in scalars
    ]


def _mapped(shape: Any, owner: PartShape, visitor: Any) -> Any:
    """Return a shape with `visitor` applied to its fields, always in the same order."""
    known = visitor.poses.get(id(shape)) if isinstance(shape, g.Pose) else None
    if known is not None:
        return known
    found: dict[str, Any] = {}
    for name in ("pose", "rest"):
        if getattr(shape, name, None) is not None:
            found[name] = _mapped(getattr(shape, name), owner, visitor)
    if isinstance(shape, g.Curve):
        found["values"] = tuple(_mapped(values, owner, visitor) for values in shape.values)
    for varies, names in ((True, MOVING), (True, CARRIED), (False, FIXED)):
        for name, size in names.get(type(shape), {}).items():
            value = getattr(shape, name)
            if value is not None:
                found[name] = visitor(
                    value, size, varies, lambda n=name: f"`{n}` of the {type(shape).__name__} of {_path(owner)}"
                )
    made = replace(shape, **found)
    if type(shape) in CARRIED:
        made = visitor.carried(made)
    if isinstance(shape, g.Pose):
        visitor.poses[id(shape)] = made
    return made


def _path(seen: PartShape) -> str:
    return f"{seen.path or 'the model'} ({seen.kind})"


class _Collector:
    """First visitor: stacks all expressions into one column."""

    def __init__(self) -> None:
        self.columns: list[Any] = []
        self.size = 0
        self.places: list[slice | None] = []
        self.sizes: list[tuple[int, ...]] = []
        self.poses: dict[int, Any] = {}

    def column(self, column: Any) -> slice:
        """Add a column and return its rows."""
        self.columns.append(dense(column))
        self.size += column.numel()
        return slice(self.size - column.numel(), self.size)

    def carried(self, shape: Any) -> Any:
        """Return the shape unchanged."""
        return shape

    def __call__(self, value: Any, size: Size, varies: bool, name: Callable[[], str]) -> Any:
        value = _number(value)
        if isinstance(value, np.ndarray):
            self.places.append(None)
            shape = value.shape
        else:
            expression = _expression(value, name)
            shape = expression.shape
            self.places.append(self.column(vec(expression.sx)))
        one = ... in size and len(shape) < len(size)
        full = (1, *shape) if one else shape
        if len(full) != len(size) or any(n not in (None, ..., m) for n, m in zip(size, full, strict=True)):
            wanted = tuple("n" if n in (None, ...) else n for n in size)
            either = f"{size[1:]} or " if ... in size else ""
            raise DeclarationError(f"{name()} has shape {shape}; it needs {either}{wanted}.".replace("'", ""))
        self.sizes.append(full)
        return value


class _Results:
    """Second visitor: replaces the expressions, in the same order, by their values."""

    def __init__(self, collected: _Collector, evaluate: Evaluate, time: np.ndarray) -> None:
        self.time, self.times = time, (times := len(time))
        self.values = np.asarray(evaluate(stacked(collected.columns))) if collected.size else np.empty((times, 0))
        self.poses: dict[int, Any] = {}
        self._next = iter(zip(collected.places, collected.sizes, strict=True))

    def carried(self, shape: Any) -> Any:
        """Return a shape with a constant center: the motion of the center is added to its pose."""
        for name in CARRIED[type(shape)]:
            at, pose = getattr(shape, name), shape.pose
            known = np.isfinite(at).all(axis=1)
            if known.any() and (not known.all() or _varies(at)):
                pose = replace(pose, r=pose.r + np.einsum("ti,tij->tj", at, pose.T))
                shape = replace(shape, **{"pose": pose, name: np.zeros(3)})
            else:
                shape = replace(shape, **{name: at[0]})
        return shape

    def __call__(self, value: Any, size: Size, varies: bool, name: Callable[[], str]) -> Any:
        place, shape = next(self._next)
        if place is None:
            numbers = _number(value).reshape(shape)
            return np.broadcast_to(numbers, (self.times, *shape)) if varies else numbers
        found = self.values[:, place]
        found = found.reshape(self.times, *shape, order="F") if shape else found[:, 0]
        if varies:
            return found
        finite = np.isfinite(found).reshape(self.times, -1)
        # An entry that is never finite was declared as None.
        known = np.asarray(finite[:, finite.any(axis=0)].all(axis=1))
        if not known.any():
            return found[0]
        if _varies(found[known]):
            raise DeclarationError(
                f"{name()} varies with time. Only a pose, the center of a Box or Sphere, the ends of a Span and the points of a "
                "Curve, Rail or Trail can vary."
            )
        if not known.all():
            caution(f"{name()} is {not_finite(known, self.time)}; the value of the other frames is taken there.")
        return found[known][0]


def not_finite(known: np.ndarray, time: np.ndarray) -> str:
    """Describe the frames at which a value is not finite; `known` is True where it is."""
    lost = np.flatnonzero(~known)
    return f"not a finite number at {len(lost)} of {len(time)} frames, the first at t = {time[lost[0]]:.6g} s"


def _varies(values: np.ndarray) -> bool:
    """Return whether values vary over time, the first dimension, by more than round-off."""
    return np.nanmax(np.abs(values - values[0]), initial=0) > CONSTANT * np.nanmax(np.abs(values), initial=0)


def _number(value: Any) -> Any:
    """Return numbers as an array with None as NaN, and anything else unchanged."""
    if isinstance(value, np.ndarray) and value.dtype.kind in "buif":
        return value
    if value is None or isinstance(value, int | float | np.number):
        return np.array(np.nan if value is None else value, dtype=float)
    if isinstance(value, list | tuple):
        rows = [_number(row) for row in value]
        if all(isinstance(row, np.ndarray) and row.shape == rows[0].shape for row in rows):
            return np.array(rows)
    return value


def _expression(value: Any, name: Callable[[], str]) -> Any:
    try:
        return as_expr([np.nan if v is None else v for v in value] if isinstance(value, list | tuple) else value)
    except DeclarationError as error:
        raise DeclarationError(f"{name()}: {error}") from None
