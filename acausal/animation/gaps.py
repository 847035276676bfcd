"""Frames at which a shape has no place: what they show instead."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from acausal.animation.collect import Seen
from acausal.animation.reading import MOVING
from acausal.errors import caution


def without_gaps(seen: Sequence[Seen], time: np.ndarray) -> list[Seen]:
    """Return shapes whose values are finite, by straight lines over time where they were not; warn of these.

    A shape with a value that is never finite is left out.
    """
    kept, doubtful, lost = [], [], []
    for one in seen:
        finite = [np.isfinite(array).all(axis=tuple(range(1, array.ndim))) for array in _arrays(one.shape)]
        if all(rows.all() for rows in finite):
            kept.append(one)
        elif all(rows.any() for rows in finite):
            doubtful.append((one.path, len(time) - int(np.all(finite, axis=0).sum())))
            kept.append(replace(one, shape=_filled(one.shape, time)))
        else:
            lost.append(one.path)
    if doubtful:
        path, count = doubtful[0]
        caution(
            f"at {count} of {len(time)} frames, a shape of {path or 'the model'} has a value that is not a number or infinite; "
            "it is drawn where it would be if it moved evenly from the frame before to the one after."
        )
    if lost:
        caution(f"a shape of {lost[0] or 'the model'} is left out: one of its values is never a finite number.")
    return kept


def _arrays(shape: Any) -> Iterator[np.ndarray]:
    """Yield what varies."""
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
            more[field.name] = _between(value, time)
        elif is_dataclass(value):
            more[field.name] = _filled(value, time)
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            more[field.name] = tuple(_filled(inner, time) for inner in value)
    return replace(shape, **more)


def _between(values: np.ndarray, time: np.ndarray) -> np.ndarray:
    flat = values.reshape(len(time), -1).copy()
    finite = np.isfinite(flat).all(axis=1)
    for column in flat.T:
        column[~finite] = np.interp(time[~finite], time[finite], column[finite])
    return flat.reshape(values.shape)
