"""From where a scene is looked at, and what is seen in which colour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# A scene whose depth is less than this part of its width or height is looked at from the front.
FLAT = 0.2
# Otherwise from the right and above, rad.
AZIMUTH, ELEVATION = 0.6, 0.4
LIGHT = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([-0.4, 0.6, 0.7])
DARKEST = 0.5


@dataclass(frozen=True)
class Camera:
    """A view without perspective.

    Parameters
    ----------
    axes : array, shape (3, 3)
        Unit vectors to the right, upwards and towards the eye, resolved in the world.
    """

    axes: np.ndarray

    def seen(self, points: np.ndarray) -> np.ndarray:
        """Return points of the world, (..., 3), to the right, upwards and towards the eye, in m."""
        return points @ self.axes.T

    def shade(self, colour: np.ndarray, normals: np.ndarray) -> np.ndarray:
        """Return colours of faces, (n, 3), from their normals in the world, (n, 3)."""
        lit = np.clip(self.seen(normals) @ LIGHT, 0, 1)
        return colour * (DARKEST + (1 - DARKEST) * lit)[:, None]


def camera(low: np.ndarray, high: np.ndarray, up: np.ndarray) -> Camera:
    """Return the view that suits a scene: along the direction in which it is flat, or from the side and above.

    Parameters
    ----------
    low, high : array, shape (3,)
        Corners of what is seen, resolved in the world.
    up : array, shape (3,)
        Unit vector.
    """
    right = level(up)
    toward = np.cross(right, up)
    wide, high_, deep = (np.abs(axis) @ (high - low) for axis in (right, up, toward))
    if deep <= FLAT * max(wide, high_):
        return Camera(np.array([right, up, toward]))
    if wide <= FLAT * max(deep, high_):
        return Camera(np.array([-toward, up, right]))
    c, s = np.cos(AZIMUTH), np.sin(AZIMUTH)
    aside, across = c * toward + s * right, c * right - s * toward
    c, s = np.cos(ELEVATION), np.sin(ELEVATION)
    return Camera(np.array([across, c * up - s * aside, c * aside + s * up]))


def level(up: np.ndarray) -> np.ndarray:
    """Return a unit vector normal to `up`, along the x axis of the world where that can be."""
    # One of the first two axes is at least 45 degrees off any direction.
    right = np.eye(3)[int(np.abs(up[0]) > np.abs(up[1]))]
    right = right - (right @ up) * up
    return right / np.linalg.norm(right)
