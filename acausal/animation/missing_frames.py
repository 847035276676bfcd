"""Interpolate shapes at frames where their position is not finite."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from acausal.animation.collect import PartShape
from acausal.animation.evaluation import MOVING, not_finite
from acausal.errors import caution


def fill_missing_frames(seen: Sequence[PartShape], time: np.ndarray) -> list[PartShape]:
    """Return shapes with finite values: others are interpolated linearly in time, with a warning.

    A shape with a value that is never finite is omitted.
    """
    finite_shapes, interpolated, omitted = [], [], []
    for one in seen:
        finite = [np.isfinite(array).all(axis=tuple(range(1, array.ndim))) for array in _arrays(one.shape)]
        if all(rows.all() for rows in finite):
            finite_shapes.append(one)
        elif all(rows.any() for rows in finite):
            interpolated.append((one, np.all(finite, axis=0)))
            finite_shapes.append(replace(one, shape=_filled(one.shape, time)))
        else:
            omitted.append(one)
    if interpolated:
        named, when = _named([one for one, _ in interpolated]), not_finite(interpolated[0][1], time)
        caution(
            f"the position of {named} is {when}; it is interpolated linearly between the neighbouring frames and held constant "
            "before the first and after the last finite one."
        )
    if omitted:
        caution(f"{_named(omitted)} is not drawn: one of its values is never a finite number.")
    return finite_shapes


def _named(seen: Iterable[PartShape]) -> str:
    """Name the first shape and count the others."""
    first, *more = seen
    others = f" and of {len(more)} other shape{'s' * (len(more) > 1)}" if more else ""
    return f"the {type(first.shape).__name__} of {first.path or 'the model'} ({first.kind}){others}"


def _arrays(shape: Any) -> Iterator[np.ndarray]:
    """Yield the arrays that vary with time."""
    for name in MOVING.get(type(shape), ()):
        if getattr(shape, name) is not None:
            yield getattr(shape, name)
    for field in fields(shape):
        value = getattr(shape, field.name)
        for inner in value if isinstance(value, tuple) else (value,):
            if is_dataclass(inner):
                yield from _arrays(inner)


def _filled(shape: Any, time: np.ndarray) -> Any:
    more: dict[str, Any] = {}
    for field in fields(shape):
        value = getattr(shape, field.name)
        if field.name in MOVING.get(type(shape), ()) and value is not None:
            more[field.name] = _interpolated(value, time)
        elif is_dataclass(value):
            more[field.name] = _filled(value, time)
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            more[field.name] = tuple(_filled(inner, time) for inner in value)
    return replace(shape, **more)


def _interpolated(values: np.ndarray, time: np.ndarray) -> np.ndarray:
    flat = values.reshape(len(time), -1).copy()
    finite = np.isfinite(flat).all(axis=1)
    for column in flat.T:
        column[~finite] = np.interp(time[~finite], time[finite], column[finite])
    return flat.reshape(values.shape)
