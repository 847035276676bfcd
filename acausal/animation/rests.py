"""From where the deformation of curves is measured: not from an end from which it would tear the machine apart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.collect import Seen

# Of the largest distance from the origin, in which positions are rounded, and of the curve: nearer points are one.
ROUNDING = 1e-12
NEAR = 1e-7


def untorn(seen: Sequence[Seen]) -> list[Seen]:
    """Return shapes with deformations from the chord where something else stands at the end that is not at rest.

    Only the curve is drawn with its deformation enlarged: what hangs on its far end, a joint, a body, the next curve, is
    drawn where it is, and so must that end be.
    """
    return [replace(one, shape=replace(one.shape, rest=None)) if _holds(one, seen) else one for one in seen]


def _holds(one: Seen, seen: Sequence[Seen]) -> bool:
    curve = one.shape
    if not isinstance(curve, g.Curve) or curve.rest is None or curve.points.shape[1] < 2:
        return False
    first, last = curve.points[:, 0], curve.points[:, -1]
    far = [np.abs(end - curve.rest.r).max() for end in (first, last)]
    end = last if far[1] >= far[0] else first
    near = NEAR * np.abs(last - first).max() + ROUNDING * np.abs(curve.points).max()
    return any(np.abs(place - end).max() <= near for other in seen if other is not one for place in _ends(other.shape))


def _ends(shape: Any) -> Iterator[np.ndarray]:
    """Yield where a shape hangs on others, shape (times, 3) each; arrows follow what they act on."""
    if isinstance(shape, g.Span):
        yield from (shape.start, shape.end)
    elif isinstance(shape, g.Curve):
        yield from (shape.points[:, 0], shape.points[:, -1])
    elif hasattr(shape, "pose"):
        yield shape.pose.r
