"""The circle or cylinder on which nodes lie."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from components.fe.arrays import Array

# Of the radius, how far nodes may be from the circle: nodes in the middle of straight edges, twelve of them around it, are
# 1 - cos(pi / 12) inside.
ROUND = 0.035
# Rays from the centre on which nodes lie: any three points are on a circle, as are the corners of a rectangle.
RAYS = 6
# Less of a circle than a quarter is a bent face, and its centre nothing that is turned about.
ARC = np.pi / 2
# Directions nearer than this, in rad, are one ray: coordinates come from files with six or seven digits.
ALIKE = 1e-3
FLAT = 1e-4  # of their extent, how far nodes are from a plane
MOST = 400  # nodes that are looked at


@dataclass(frozen=True)
class Circle:
    """A circle, or the axis of a cylinder.

    Parameters
    ----------
    centre, axis : array, shape (3,)
        Place in m, direction of length 1.
    radius : float
        In m.
    """

    centre: Array
    axis: Array
    radius: float

    def nearest(self, place: Array) -> Array:
        """Return the point of the axis nearest to a place."""
        return self.centre + self.axis * (self.axis @ (place - self.centre))


def circle_of(places: Array) -> Circle | None:
    """Return the circle or cylinder on which places lie, shape (k, 3); None if they lie on none."""
    if len(places) < RAYS:
        return None
    some = places[:: -(-len(places) // MOST)]
    arms = some - some.mean(axis=0)
    size = np.linalg.norm(arms, axis=1).max()
    _, spread, directions = np.linalg.svd(arms, full_matrices=False)
    if not size or spread[1] <= FLAT * spread[0]:
        return None
    found = [directions[2]] if spread[2] <= FLAT * spread[0] else _axes(arms / size, directions)
    circles = [(_off(arms, axis), axis) for axis in found]
    off, axis = min(circles, key=lambda entry: entry[0])
    if off > ROUND:
        return None
    centre, radius, flat = _fitted(arms, axis)
    angles = np.sort(np.arctan2(*(flat - centre).T))
    gaps = np.diff(angles, append=angles[0] + 2 * np.pi)
    if np.count_nonzero(gaps > ALIKE) < RAYS or gaps.max() > 2 * np.pi - ARC:
        return None
    return Circle(some.mean(axis=0) + centre @ _plane(axis), axis, radius)


def _axes(arms: Array, starts: Array) -> list[Array]:
    """Directions of cylinders that fit, each sought from one of the starts."""
    from scipy.optimize import least_squares

    found = []
    for start in starts:
        plane = _plane(start)

        def turned(two: Array, start: Array = start, plane: Array = plane) -> Array:
            axis = start + two @ plane
            return axis / np.linalg.norm(axis)

        def distances(two: Array, turned: Any = turned) -> Array:
            centre, radius, flat = _fitted(arms, turned(two))
            return np.linalg.norm(flat - centre, axis=1) - radius

        found.append(turned(least_squares(distances, np.zeros(2), method="lm").x))
    return found


def _off(arms: Array, axis: Array) -> float:
    """Largest distance of points from the circle that fits them best across an axis, by its radius."""
    centre, radius, flat = _fitted(arms, axis)
    return float(np.abs(np.linalg.norm(flat - centre, axis=1) / radius - 1).max()) if radius else np.inf


def _fitted(arms: Array, axis: Array) -> tuple[Array, float, Array]:
    """Centre and radius of the circle |x|^2 = 2 c . x + k across an axis, and the points in its plane (Kasa 1976)."""
    flat = arms @ _plane(axis).T
    (x, y, rest), *_ = np.linalg.lstsq(np.c_[2 * flat, np.ones(len(flat))], (flat**2).sum(axis=1), rcond=None)
    return np.array([x, y]), float(np.sqrt(max(rest + x * x + y * y, 0.0))), flat


def _plane(axis: Array) -> Array:
    """Two directions across an axis, shape (2, 3)."""
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first = first / np.linalg.norm(first)
    return np.stack([first, np.cross(axis, first)])
