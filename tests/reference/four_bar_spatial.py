"""Spatial four-bar: revolute, rod, universal of three revolutes, rod, two revolutes, rod, slider along x."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.reference.spatial_loop import Joint, Loop, Rod

Array = NDArray[np.float64]
X, Y, Z = np.eye(3)
CRANK, SLIDER = np.array([0, 0.5, 0.1]), np.array([1.0, 0, 0])
UPPER = SLIDER + 0.2 * Y


def cylinder(start: Array, end: Array, diameter: float = 0.05, density: float = 7700.0) -> Rod:
    """Return a cylinder from its ends and size."""
    length = float(np.linalg.norm(end - start))
    mass = density * np.pi / 4 * diameter**2 * length
    return Rod.between(start, end, mass, mass * (3 * diameter**2 / 4 + length**2) / 12, mass * diameter**2 / 8)


def loop(gravity: float = 9.80665) -> Loop:
    """Return the mechanism, in the order j1, j3, j4, j5, rev1, rev, j2."""
    joints = [
        *(Joint(X), Joint(X, CRANK), Joint(Y, CRANK), Joint(Z, CRANK)),
        *(Joint(Z, UPPER), Joint(Y, UPPER), Joint(X, SLIDER, slides=True)),
    ]
    bodies = [
        *(cylinder(np.zeros(3), CRANK), Rod(), Rod()),
        *(cylinder(UPPER, CRANK), Rod(), cylinder(SLIDER, UPPER)),
    ]
    return Loop(joints, bodies, (0.0, -gravity, 0.0))


def simulate(times: ArrayLike, w: float = 5.235987756) -> Array:
    """Return angle and angular velocity of j1, shape (len(times), 2)."""
    mechanism = loop()
    return mechanism.simulate(times, mechanism.rates(0, w))[:, [0, 7]]
