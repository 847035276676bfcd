"""View direction and shading of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# A scene is flat, and viewed face on, if its depth is less than this fraction of its width or height.
FLAT = 0.2
VIEWS = ("front", "top", "right", "iso")
# View of other scenes, from the right and above, rad.
AZIMUTH, ELEVATION = 0.6, 0.4
LIGHT = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([-0.4, 0.6, 0.7])
DARKEST = 0.6  # brightness of a face that is turned away from the light, relative to a lit one


@dataclass(frozen=True)
class Camera:
    """Orthographic camera.

    Parameters
    ----------
    axes : array, shape (3, 3)
        Unit vectors to the right, upwards and towards the viewer, resolved in the world.
    """

    axes: np.ndarray

    def project(self, points: np.ndarray) -> np.ndarray:
        """Return points of the world, (..., 3), resolved in the axes of the camera, in m."""
        return points @ self.axes.T

    def shade(self, colour: np.ndarray, normals: np.ndarray) -> np.ndarray:
        """Return the shaded colours of faces, (n, 3), with normals (n, 3) in the world."""
        lit = np.clip(self.project(normals) @ LIGHT, 0, 1)
        return colour * (DARKEST + (1 - DARKEST) * lit)[:, None]


def camera(low: np.ndarray, high: np.ndarray, up: np.ndarray) -> Camera:
    """Return the default camera of a scene: face on if the scene is flat, otherwise from the right and above.

    Parameters
    ----------
    low, high : array, shape (3,)
        Corners of the scene, resolved in the world.
    up : array, shape (3,)
        Unit vector, resolved in the world.
    """
    right = horizontal(up)
    toward = np.cross(right, up)
    wide, high_, deep = (np.abs(axis) @ (high - low) for axis in (right, up, toward))
    if deep <= FLAT * max(wide, high_):
        return standard("front", up)
    if wide <= FLAT * max(deep, high_):
        return standard("right", up)
    return standard("iso", up)


def standard(view: str, up: np.ndarray) -> Camera:
    """Return the camera of a view: "front", "top", "right" or "iso", from the right and above."""
    right = horizontal(up)
    toward = np.cross(right, up)
    if view == "front":
        return Camera(np.array([right, up, toward]))
    if view == "right":
        return Camera(np.array([-toward, up, right]))
    if view == "top":
        return Camera(np.array([right, -toward, up]))
    c, s = np.cos(AZIMUTH), np.sin(AZIMUTH)
    aside, across = c * toward + s * right, c * right - s * toward
    c, s = np.cos(ELEVATION), np.sin(ELEVATION)
    return Camera(np.array([across, c * up - s * aside, c * aside + s * up]))


def horizontal(up: np.ndarray) -> np.ndarray:
    """Return the x axis of the world, or y if that is farther from `up`, projected normal to `up` and normalised."""
    # At least one of the x and y axes is 45 degrees or more away from any direction.
    right = np.eye(3)[int(np.abs(up[0]) > np.abs(up[1]))]
    right = right - (right @ up) * up
    return right / np.linalg.norm(right)
