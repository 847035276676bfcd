"""Choose the reference from which the deformation of a curve is exaggerated: its root or its chord."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import PartShape

# Points coincide if they are nearer than this fraction of the distance from the origin (round-off of positions) plus this
# fraction of the chord (tolerance of the run).
ROUND_OFF = 1e-12
COINCIDENT = 1e-7


def with_references(seen: Sequence[PartShape]) -> list[PartShape]:
    """Return shapes in which curves with another shape at their far end take the chord as their reference.

    Only the deformation of the curve is exaggerated. A joint, body or curve at its far end is drawn at its true position, so
    that end must not move either.
    """
    return [replace(one, shape=replace(one.shape, rest=None)) if _is_loaded(one, seen) else one for one in seen]


def _is_loaded(one: PartShape, seen: Sequence[PartShape]) -> bool:
    """Return whether another shape is attached to the far end of a curve."""
    curve = one.shape
    if not isinstance(curve, g.Curve) or curve.rest is None or curve.points.shape[1] < 2:
        return False
    first, last = curve.points[:, 0], curve.points[:, -1]
    far = [np.abs(end - curve.rest.r).max() for end in (first, last)]
    end = last if far[1] >= far[0] else first
    near = COINCIDENT * np.abs(last - first).max() + ROUND_OFF * np.abs(curve.points).max()
    return any(np.abs(place - end).max() <= near for other in seen if other is not one for place in _ends(other.shape))


def _ends(shape: Any) -> Iterator[np.ndarray]:
    """Yield the points, shape (times, 3), at which a shape can be attached to others; an arrow is attached to nothing."""
    if isinstance(shape, g.Span):
        yield from (shape.start, shape.end)
    elif isinstance(shape, g.Curve):
        yield from (shape.points[:, 0], shape.points[:, -1])
    elif hasattr(shape, "pose"):
        yield shape.pose.r
