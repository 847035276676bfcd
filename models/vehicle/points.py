"""Hard points of a suspension, and inertia tensors."""

from __future__ import annotations

from math import dist
from typing import Any

from acausal import structural

Vector = tuple[float, float, float]


def point(description: str, *r: float) -> Any:
    """Declare a hard point of a suspension on the right."""
    return structural(f"{description}, resolved in frame_a, in m", default=r, shape=(3,), doc="On the left, z is -z.")


def offset(start: Any, end: Any, side: int) -> Vector:
    """Return the vector from one point to another, on the right (side 1) or on the left (-1)."""
    x, y, z = (float(b - a) for a, b in zip(start, end, strict=True))
    return x, y, side * z


def length(start: Any, end: Any) -> float:
    """Return the distance between two points."""
    return dist(start, end)


def diagonal(x: float, y: float, z: float) -> tuple[Vector, Vector, Vector]:
    """Return the inertia tensor with principal moments about x, y and z."""
    return (x, 0, 0), (0, y, 0), (0, 0, z)
