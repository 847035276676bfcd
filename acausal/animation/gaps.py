"""Frames at which a shape has no place: what they show instead."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from acausal.animation.collect import Seen
from acausal.animation.reading import MOVING, not_finite
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
            doubtful.append((one, np.all(finite, axis=0)))
            kept.append(replace(one, shape=_filled(one.shape, time)))
        else:
            lost.append(one)
    if doubtful:
        named, when = _named([one for one, _ in doubtful]), not_finite(doubtful[0][1], time)
        caution(
            f"the place of {named} is {when}; it is drawn where it would be if it moved evenly from the frame before to the one "
            "after, and rested where there is none."
        )
    if lost:
        caution(f"{_named(lost)} is left out: one of its values is never a finite number.")
    return kept


def _named(seen: Iterable[Seen]) -> str:
    """Name the first shape, and how many more there are."""
    first, *more = seen
    others = f" and of {len(more)} other shape{'s' * (len(more) > 1)}" if more else ""
    return f"the {type(first.shape).__name__} of {first.path or 'the model'} ({first.kind}){others}"


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
