"""Frames at nodes: displacement and rotation of each frame in terms of its nodes."""

from __future__ import annotations

import keyword
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array
from components.fe.elements.faces import area_weights
from components.fe.reduction.circle_fit import circle_of
from components.fe.reduction.spiders import Spider, indices
from components.fe.user_warning import warn

# Distance of nodes from a line, relative to their extent, below which they count as collinear: file coordinates have
# six or seven digits.
ON_A_LINE = 1e-5
# Offset of a frame from the axis of the circle through its nodes, relative to the radius: within the clearance of a
# bearing.
OFF_CENTRE = 1e-3


@dataclass(frozen=True)
class Frame:
    """A frame of the body before its reduction.

    Parameters
    ----------
    name : str
        Name of the port.
    nodes : array of int
        Its nodes.
    kind : str
        "rigid", "average", or "" (nodes fixed if the reference frame is fixed to the frame, else averaged).
    place : array, shape (3,)
        Position of the frame in m.
    orientation : array, shape (3, 3)
        Axes x, y, z of the frame as rows.
    maps : array, shape (6, 3 k)
        Displacement and small rotation of the frame by the displacements of its k nodes.
    axes : array, shape (3, r)
        Axes of the rotations that the nodes define; r is 0 for a point, 2 for collinear nodes.
    radius : float
        Root mean square distance of the nodes from their mean position in m, 1 for a point.
    """

    name: str
    nodes: Array
    kind: str
    place: Array
    orientation: Array
    maps: Array
    axes: Array
    radius: float

    @property
    def equations(self) -> Array:
        """Indices of the equations of the nodes, x, y, z of each."""
        return (3 * self.nodes[:, None] + np.arange(3)).ravel()

    @property
    def turns(self) -> bool:
        """True if the nodes define all rotations."""
        return self.axes.shape[1] == 3

    @property
    def freedoms(self) -> Array:
        """Independent rows of `maps`, rotations as lengths at the radius, shape (3 + r, 3 k)."""
        return np.vstack([self.maps[:3], self.radius * self.axes.T @ self.maps[3:]])


def frame(name: str, nodes: Any, places: Array, cells: Mapping[str, Array]) -> Frame:
    """Return a frame at some of the nodes with positions `places`, shape (N, 3), and elements `cells`."""
    spider = nodes if isinstance(nodes, Spider) else Spider(indices(nodes))
    rows = _rows(name, spider, len(places))
    shares = _shares(spider, rows, places, cells)
    at = places[rows]
    mean = shares @ at
    arms = at - mean
    squares, directions = np.linalg.eigh((shares[:, None] * arms).T @ arms)
    squares = np.maximum(squares, 0.0)
    radius = float(np.sqrt(squares.sum())) or 1.0
    # Second moments of the weights about the principal axes through the mean position: the nodes define the rotation
    # about an axis unless they lie on it.
    moments = squares.sum() - squares
    held = np.sqrt(moments) > ON_A_LINE * radius
    axes = directions[:, held]
    crossed = np.concatenate([share * _skew(arm) for share, arm in zip(shares, arms, strict=True)], axis=1)
    rotation = axes / moments[held] @ axes.T @ crossed
    moved = np.concatenate([share * np.eye(3) for share in shares], axis=1)
    if spider.place is None:
        place = mean
        if spider.weights is None:
            _warn_off_centre(name, at, place)
    else:
        place = np.array(spider.place)
        _check_place(name, place - mean, directions[:, ~held], float(np.linalg.norm(np.ptp(places, axis=0))))
        moved = moved - _skew(place - mean) @ rotation
    orientation = np.eye(3) if spider.axes is None else spider.axes
    return Frame(name, rows, spider.kind, place, orientation, np.vstack([moved, rotation]), axes, radius)


def _rows(name: str, spider: Spider, count: int) -> Array:
    wrong = [k for k in spider.nodes if not 0 <= k < count]
    if wrong:
        raise DeclarationError(f"frame {name!r} refers to node {wrong[0]}, but nodes are numbered 0 to {count - 1}")
    if len(set(spider.nodes)) < len(spider.nodes):
        twice = next(k for k in spider.nodes if spider.nodes.count(k) > 1)
        raise DeclarationError(f"frame {name!r} contains node {twice} twice")
    return np.array(spider.nodes)


def _shares(spider: Spider, rows: Array, places: Array, cells: Mapping[str, Array]) -> Array:
    """Return the normalised weights of the nodes."""
    found = area_weights(rows, places, cells) if spider.weights is None else np.array(spider.weights)
    found = np.ones(len(rows)) if found is None else found
    return found / found.sum()


def _warn_off_centre(name: str, at: Array, place: Array) -> None:
    """Warn if the nodes lie on a circle or cylinder, but the frame is off its axis."""
    circle = circle_of(at)
    if circle is None:
        return
    centre = circle.nearest(place)
    off = float(np.linalg.norm(place - centre))
    if off > OFF_CENTRE * circle.radius:
        x, y, z = (float(np.round(value, 9)) for value in centre)
        warn(
            f"frame {name!r} is at the mean of its nodes, {off:.3g} m off the axis of the circle of radius {circle.radius:.4g} m "
            f"through them. Do this: frames={{{name!r}: frame_at(nodes, place=({x:.9g}, {y:.9g}, {z:.9g}))}}"
        )


def _check_place(name: str, shift: Array, loose: Array, size: float) -> None:
    """Refuse a position whose motion the nodes do not define: off the line of collinear nodes, or off a single node."""
    line = loose.shape[1] == 1
    beside = shift - loose @ (loose.T @ shift) if line else shift
    if loose.shape[1] and np.linalg.norm(beside) > ON_A_LINE * size:
        where = "on the line of its nodes" if line else "at its node"
        raise DeclarationError(
            f"the place of frame {name!r} must be {where}, as its nodes define no rotation; use nodes that are not collinear"
        )


def _skew(r: Array) -> Array:
    return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])


def frames_of(frames: Mapping[str, Any], places: Array, empty: Array, cells: Mapping[str, Array]) -> list[Frame]:
    """Return the frames of the user, checked.

    Raises
    ------
    DeclarationError
        If a name is not a Python identifier, or a node does not exist, occurs twice or has no stiffness.
    """
    if not isinstance(frames, Mapping):
        raise DeclarationError(f'frames must map names to nodes, such as {{"tip": [53]}}, not {frames!r}')
    found = []
    for name, nodes in frames.items():
        if not isinstance(name, str) or not name.isidentifier() or keyword.iskeyword(name):
            raise DeclarationError(f"the name of a frame must be a Python identifier, not {name!r}")
        made = frame(name, nodes, places, cells)
        if empty[made.nodes].any():
            raise DeclarationError(f"node {made.nodes[empty[made.nodes]][0]} of frame {name!r} has no stiffness")
        found.append(made)
    return found
