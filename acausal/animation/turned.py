"""Faces of solids of revolution."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from acausal.animation.looks import Layer, corners_of

# Films draw whole faces by the depth of their centres: so long ones are divided into pieces of this length in diameters, at most
# PIECES, and circles have no more corners than this.
PIECE, PIECES, SIDES = 1.0, 40, 20


def rings(layer: Layer, start: np.ndarray, end: np.ndarray, side: np.ndarray, diameter: float) -> Iterator[np.ndarray]:
    """Yield the rings of a layer between two points of the world.

    Parameters
    ----------
    layer : Layer
        Layer of a look.
    start, end : array, shape (3,)
        Ends of the axis, in m.
    side : array, shape (3,)
        Unit vector normal to the axis, from which angles are counted.
    diameter : float
        In m.

    Returns
    -------
    iterator of array, shape (corners, 3)
        Corners in m, anticlockwise seen from `end`.
    """
    length = float(np.linalg.norm(end - start))
    along = (end - start) / (length or 1)
    angles, radii = corners_of(layer, SIDES)
    around = radii[:, None] * (np.cos(angles)[:, None] * side + np.sin(angles)[:, None] * np.cross(along, side))
    rows = np.array(layer.rows)
    for row, after in pairwise(rows):
        count = 1 + min(int(abs(after[0] - row[0]) * length / (PIECE * diameter or 1)), PIECES - 1)
        for k in range(count):
            yield _ring(row + k / count * (after - row), start, along, length, around, diameter)
    yield _ring(rows[-1], start, along, length, around, diameter)


def _ring(
    row: np.ndarray, start: np.ndarray, along: np.ndarray, length: float, around: np.ndarray, diameter: float
) -> np.ndarray:
    place, beyond, radius = row
    return start + (place * length + beyond * diameter) * along + radius * diameter * around


def faces(count: int, sides: int) -> np.ndarray:
    """Return the faces between `count` rings of `sides` corners, (n, 4) rows of corners, anticlockwise from outside."""
    k = np.arange(sides)
    after = (k + 1) % sides
    band = np.stack([k, after, after + sides, k + sides], axis=1)
    return (np.arange(count - 1)[:, None, None] * sides + band).reshape(-1, 4)


def normal_to(axis: np.ndarray) -> np.ndarray:
    """Return a unit vector normal to an axis: that of the world which is farthest from it, made normal."""
    axis = axis / (np.linalg.norm(axis) or 1)
    side = np.eye(3)[int(np.argmin(np.abs(axis)))]
    side = side - (side @ axis) * axis
    return side / (np.linalg.norm(side) or 1)
