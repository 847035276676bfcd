"""Frames at sets of nodes: rigid and averaging spiders."""

from __future__ import annotations

import keyword
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array

# Coordinates come from files with six or seven digits: nodes nearer to a line than this part of their extent are on it.
ON_A_LINE = 1e-5


@dataclass(frozen=True)
class Spider:
    """Nodes that carry a frame; see `rigid` and `average`."""

    nodes: tuple[int, ...]
    weights: tuple[float, ...]
    kind: str  # "" (as the frame is used), "rigid" or "average"


def rigid(nodes: Any) -> Spider:
    """A rigid spider: the nodes move as one rigid body, which stiffens what they are part of.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    """
    found = _indices(nodes)
    return Spider(found, (1.0,) * len(found), "rigid")


def average(nodes: Any, weights: Any = None) -> Spider:
    """An averaging spider: the frame follows the nodes and stiffens nothing.

    It is displaced by the mean of the nodes' displacements u, and turned by the rotation that fits them best, with d the
    nodes' distances from their mean place: Psi = (sum w (|d|^2 E - d d'))^-1 sum w d x u. A force on the frame is
    distributed over the nodes in the same proportion.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    weights : sequence of float, optional
        Positive weight w of each node, all equal by default.

    Raises
    ------
    DeclarationError
        If there are not as many weights as nodes, or one is not positive.
    """
    found = _indices(nodes)
    shares = np.ones(len(found)) if weights is None else np.asarray(weights, dtype=float)
    if shares.shape != (len(found),) or not (np.isfinite(shares) & (shares > 0)).all():
        raise DeclarationError(
            f"an averaging frame needs one positive weight for each of its {len(found)} nodes: {weights!r}"
        )
    return Spider(found, tuple(shares.tolist()), "average")


def _indices(nodes: Any) -> tuple[int, ...]:
    array = np.atleast_1d(np.asarray(nodes))
    if array.ndim != 1 or not len(array) or not np.issubdtype(array.dtype, np.integer):
        raise DeclarationError(f"a frame needs the indices of its nodes, counted from 0, not {nodes!r}")
    return tuple(array.tolist())


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
        "" (each node held in a frame that the reference frame holds, else their average), "rigid" or "average".
    place : array, shape (3,)
        Mean place of the nodes in m.
    maps : array, shape (6, 3 k)
        Displacement and small rotation of the frame from the displacements of its k nodes.
    axes : array, shape (3, r)
        Directions about which the nodes hold a turn; r is 0 for a point, 2 for nodes on a line.
    radius : float
        Mean distance of the nodes from the place in m, 1 for a point.
    """

    name: str
    nodes: Array
    kind: str
    place: Array
    maps: Array
    axes: Array
    radius: float

    @property
    def equations(self) -> Array:
        """Numbers of the equations of the nodes, x, y, z of each."""
        return (3 * self.nodes[:, None] + np.arange(3)).ravel()

    @property
    def turns(self) -> bool:
        """Whether the nodes hold every turn."""
        return self.axes.shape[1] == 3

    @property
    def freedoms(self) -> Array:
        """Rows of `maps` that are independent, turns as lengths at the radius, shape (3 + r, 3 k)."""
        return np.vstack([self.maps[:3], self.radius * self.axes.T @ self.maps[3:]])


def frame(name: str, nodes: Any, places: Array) -> Frame:
    """A frame at some of the nodes at `places`, shape (N, 3)."""
    spider = nodes if isinstance(nodes, Spider) else Spider(found := _indices(nodes), (1.0,) * len(found), "")
    wrong = [k for k in spider.nodes if not 0 <= k < len(places)]
    if wrong:
        raise DeclarationError(
            f"frame {name!r} names node {wrong[0]}, but nodes are counted from 0 to {len(places) - 1}"
        )
    if len(set(spider.nodes)) < len(spider.nodes):
        twice = next(k for k in spider.nodes if spider.nodes.count(k) > 1)
        raise DeclarationError(f"frame {name!r} names node {twice} twice")
    shares = np.array(spider.weights) / np.sum(spider.weights)
    at = places[list(spider.nodes)]
    place = shares @ at
    arms = at - place
    _, spread, directions = np.linalg.svd(np.linalg.qr(np.sqrt(shares)[:, None] * arms, mode="r"))
    spread = np.concatenate([spread, np.zeros(3)])[:3]
    radius = float(np.linalg.norm(spread)) or 1.0
    # Moments of the weights about the principal lines through the place: the nodes hold a turn about a line that they
    # are not on.
    moments = np.maximum(np.sum(spread**2) - spread**2, 0.0)
    held = np.sqrt(moments) > ON_A_LINE * radius
    axes = directions[held].T
    crossed = np.concatenate([share * _skew(arm) for share, arm in zip(shares, arms, strict=True)], axis=1)
    rotation = axes / moments[held] @ axes.T @ crossed
    mean = np.concatenate([share * np.eye(3) for share in shares], axis=1)
    return Frame(name, np.array(spider.nodes), spider.kind, place, np.vstack([mean, rotation]), axes, radius)


def _skew(r: Array) -> Array:
    return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])


def frames_of(frames: Mapping[str, Any], places: Array, empty: Array) -> list[Frame]:
    """The frames that a user names, checked.

    Raises
    ------
    DeclarationError
        If a name is no Python name, or a node is not there, is named twice, or has no stiffness.
    """
    if not isinstance(frames, Mapping):
        raise DeclarationError(f'frames maps names to nodes, as {{"tip": [53]}}, which {frames!r} does not')
    found = []
    for name, nodes in frames.items():
        if not isinstance(name, str) or not name.isidentifier() or keyword.iskeyword(name):
            raise DeclarationError(f"a frame is a port, and needs a name as Python has them, not {name!r}")
        made = frame(name, nodes, places)
        if empty[made.nodes].any():
            raise DeclarationError(f"node {made.nodes[empty[made.nodes]][0]} of frame {name!r} has no stiffness")
        found.append(made)
    return found
