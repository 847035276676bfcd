"""Arrange shapes that depend on the whole scene: rails as long as their paths, and the axes of supports."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.camera import horizontal
from acausal.animation.collect import PartShape

# Points coincide at the start if they are nearer than this fraction of the scene: the tolerance of a run.
COINCIDENT = 1e-4


@dataclass(frozen=True)
class End:
    """End of a long shape at the start: point (3,) and outward direction (3,) in the world, and thickness in m if declared."""

    point: np.ndarray
    direction: np.ndarray
    thickness: float | None


def with_rails(seen: Sequence[PartShape]) -> list[PartShape]:
    """Return shapes with cylinders in place of rails."""
    return [replace(one, shape=_rail(one.shape)) if isinstance(one.shape, g.Rail) else one for one in seen]


def _rail(rail: g.Rail) -> g.Cylinder:
    axis = np.asarray(rail.axis) / np.linalg.norm(rail.axis)
    along = np.einsum("tij,tj->ti", rail.pose.T, rail.to - rail.pose.r) @ axis
    return g.Cylinder(rail.pose, along.min() * axis, along.max() * axis, style=rail.style)


def with_axes(seen: Sequence[PartShape], up: np.ndarray, size: float) -> list[PartShape]:
    """Return shapes in which each axis is known, without supports that hold nothing.

    Parameters
    ----------
    seen : sequence of PartShape
        Evaluated shapes.
    up : array, shape (3,)
        Vertical unit vector of the scene.
    size : float
        Size of the scene in m.
    """
    axles = [one.shape for one in seen if isinstance(one.shape, g.Axle) and one.shape.axis is not None]
    ends = [end for one in seen for end in ends_of(one.shape)]
    found = []
    for one in seen:
        if isinstance(one.shape, g.Axle) and one.shape.axis is None:
            axis = _axis(one.shape, axles, ends, up, size)
            found += [] if axis is None else [replace(one, shape=replace(one.shape, axis=axis))]
        else:
            found.append(one)
    return found


def _axis(axle: g.Axle, axles: Sequence[g.Axle], ends: Sequence[End], up: np.ndarray, size: float) -> np.ndarray | None:
    """Return the axis of a support, resolved in its pose, out of the wall or floor behind it; None if it holds nothing."""
    here = axle.pose.r[0]
    joints = [other for other in axles if near(other.pose.r[0], here, size)]
    for joint in joints:
        if joint.style == "hinge":
            axis = joint.axis @ joint.pose.T[0]
            # The wall is behind or below what is seen from the front.
            right = horizontal(up)
            front = up + np.cross(right, up) / 2 + right / 4
            return axle.pose.T[0] @ (axis if axis @ front > 0 else -axis)
    found = [-end.direction for end in ends if near(end.point, here, size)]
    return axle.pose.T[0] @ (found[0] if found else up) if found or joints else None


def near(a: np.ndarray, b: np.ndarray, size: float) -> bool:
    """Return whether two points coincide in a scene of a size in m."""
    return bool(np.abs(a - b).max() <= COINCIDENT * size)


def ends_of(shape: Any) -> Iterator[End]:
    """Yield the two ends of a long shape at the start."""
    if isinstance(shape, g.Curve):
        first, last = shape.points[0, [0, 1]], shape.points[0, [-1, -2]]
        section = np.asarray(shape.section, dtype=float)
        thickness = 2 * float(np.nanmax(section)) if np.isfinite(section).any() else None
        yield from (_end(first[0], first[1], thickness), _end(last[0], last[1], thickness))
    elif isinstance(shape, g.Span):
        yield from (_end(shape.start[0], shape.end[0], None), _end(shape.end[0], shape.start[0], None))
    elif isinstance(shape, g.Cylinder | g.Box):
        a, b, thickness = _axis_of(shape)
        a, b = (shape.pose.r[0] + point @ shape.pose.T[0] for point in (a, b))
        yield from (_end(a, b, thickness), _end(b, a, thickness))


def _axis_of(shape: g.Cylinder | g.Box) -> tuple[np.ndarray, np.ndarray, float | None]:
    """Return both ends of a solid in its pose, and its thickness."""
    if isinstance(shape, g.Cylinder):
        return np.asarray(shape.start), np.asarray(shape.end), shape.diameter
    half = shape.axes[0] * shape.size[0] / 2
    return shape.center - half, shape.center + half, float(min(shape.size[1:]))


def _end(point: np.ndarray, other: np.ndarray, thickness: float | None) -> End:
    step = point - other
    return End(point, step / (np.linalg.norm(step) or 1.0), thickness)
