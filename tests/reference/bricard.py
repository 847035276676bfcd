"""Bricard's mechanism: six revolutes and five moving rods along edges of a cube, released at rest under gravity."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.reference.spatial_loop import Joint, Loop, Rod

Array = NDArray[np.float64]
POINTS = ((0, 0, 0), (1, 0, 0), (1, -1, 0), (1, -1, 1), (0, -1, 1), (0, 0, 1))
AXES = ((0, 1, 0), (0, 0, 1), (1, 0, 0)) * 2


def loop(gravity: float = 9.81, side: float = 0.1) -> Loop:
    """Return the mechanism of rods of 1 m, 1 kg and square section."""
    rods = [Rod.between(a, b, 1.0, (1 + side**2) / 12, side**2 / 6) for a, b in pairwise(POINTS)]
    joints = [Joint(axis, point) for axis, point in zip(AXES, POINTS, strict=True)]
    return Loop(joints, rods, (0.0, -gravity, 0.0))


def point(times: ArrayLike, gravity: float = 9.81) -> Array:
    """Return the positions of the point that starts at (1, -1, 0), shape (len(times), 3)."""
    mechanism = loop(gravity)
    return np.array([mechanism.point(state, 1, POINTS[2]) for state in mechanism.simulate(times)])
