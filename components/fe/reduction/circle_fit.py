"""Fit of a circle or cylinder through nodes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from components.fe.arrays import Array

# Radial deviation of nodes, relative to the radius: mid-edge nodes of twelve straight edges are 1 - cos(pi / 12) =
# 0.034 inside.
ROUND = 0.035
# Distinct angles of nodes: three points and the corners of a rectangle always lie on a circle.
RAYS = 6
# Angle in rad that nodes must cover: less than a quarter of a circle is a curved face, not a bearing.
ARC = np.pi / 2
# Angles in rad that count as equal: file coordinates have six or seven digits.
ALIKE = 1e-3
FLAT = 1e-4  # distance of nodes from a plane, relative to their extent: file coordinates have six or seven digits
MOST = 400  # nodes used in the fit


@dataclass(frozen=True)
class Circle:
    """A circle, or the axis of a cylinder.

    Parameters
    ----------
    centre, axis : array, shape (3,)
        Position in m, and unit vector.
    radius : float
        In m.
    """

    centre: Array
    axis: Array
    radius: float

    def nearest(self, place: Array) -> Array:
        """Return the point of the axis nearest to a position."""
        return self.centre + self.axis * (self.axis @ (place - self.centre))


def circle_of(places: Array) -> Circle | None:
    """Return the circle or cylinder through positions, shape (k, 3), or None."""
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
    """Fit the cylinder axis from each start direction."""
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
    """Return the largest radial deviation from the circle fitted across an axis, relative to its radius."""
    centre, radius, flat = _fitted(arms, axis)
    return float(np.abs(np.linalg.norm(flat - centre, axis=1) / radius - 1).max()) if radius else np.inf


def _fitted(arms: Array, axis: Array) -> tuple[Array, float, Array]:
    """Fit |x|^2 = 2 c . x + k across an axis (Kasa 1976); return centre, radius and the points in the plane."""
    flat = arms @ _plane(axis).T
    (x, y, rest), *_ = np.linalg.lstsq(np.c_[2 * flat, np.ones(len(flat))], (flat**2).sum(axis=1), rcond=None)
    return np.array([x, y]), float(np.sqrt(max(rest + x * x + y * y, 0.0))), flat


def _plane(axis: Array) -> Array:
    """Return two unit vectors normal to an axis, shape (2, 3)."""
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first = first / np.linalg.norm(first)
    return np.stack([first, np.cross(axis, first)])
