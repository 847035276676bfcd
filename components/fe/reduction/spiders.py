"""Sets of nodes that carry a frame: rigid and averaging spiders, their place and axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array

# Axes are given with six or seven digits: how far a third one may be from right angles.
SQUARE = 1e-5


@dataclass(frozen=True)
class Spider:
    """Nodes that carry a frame; see `frame_at`, `rigid` and `average`.

    Parameters
    ----------
    nodes : tuple of int
        Rows of the nodes.
    kind : str
        "" (as the frame is used), "rigid" or "average".
    weights : tuple of float, optional
        Of each node; by default those of the area of the faces that the nodes span.
    place : tuple of 3 floats, optional
        In m; by default the weighted mean of the nodes.
    axes : array, shape (3, 3), optional
        Directions x, y, z of the frame as rows; by default those of the nodes' coordinates.
    """

    nodes: tuple[int, ...]
    kind: str = ""
    weights: tuple[float, ...] | None = None
    place: tuple[float, ...] | None = None
    axes: Array | None = None


def frame_at(nodes: Any, place: Any = None, axes: Any = None) -> Spider:
    """A frame at a place, with axes of its own: held or averaging as nodes without this are.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    place : 3 floats, optional
        Place of the frame in m, in the coordinates of the nodes, such as the centre of a hole. By default the mean of the
        nodes, weighted by the area of the faces that they span.
    axes : 2 or 3 vectors, optional
        Direction of x, a vector in the plane of x and y, and z if given, in the coordinates of the nodes. By default the
        axes of the coordinates.

    Raises
    ------
    DeclarationError
        If the place is no place, or the axes are no right-handed ones.

    Examples
    --------
    >>> frames = {"hinge": frame_at([0, 2, 4], place=(0, 0, 0), axes=((0, 0, 1), (1, 0, 0)))}
    """
    return Spider(indices(nodes), "", None, _place(place), _axes(axes))


def rigid(nodes: Any, *, place: Any = None, axes: Any = None) -> Spider:
    """A rigid spider: the nodes move as one rigid body, which stiffens what they are part of.

    Faces that are welded to another body are rigid ones: the mean of a face follows a joint of two averages more softly than
    the material.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    place, axes : optional
        See `frame_at`.
    """
    return Spider(indices(nodes), "rigid", None, _place(place), _axes(axes))


def average(nodes: Any, weights: Any = None, *, place: Any = None, axes: Any = None) -> Spider:
    """An averaging spider: the frame follows the nodes and stiffens nothing.

    Its mean place is displaced by the mean of the nodes' displacements u, and turned by the rotation that fits them best,
    with d the nodes' distances from the mean place: Psi = (sum w (|d|^2 E - d d'))^-1 sum w d x u. A force on the frame is
    distributed over the nodes in the same proportion.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    weights : sequence of float, optional
        Positive weight w of each node. By default the integral of its shape function over the faces of the mesh that the
        nodes span, so that a force acts as a uniform pressure; equal ones where no faces are known.
    place, axes : optional
        See `frame_at`.

    Raises
    ------
    DeclarationError
        If there are not as many weights as nodes, or one is not positive.
    """
    found = indices(nodes)
    if weights is None:
        return Spider(found, "average", None, _place(place), _axes(axes))
    shares = np.asarray(weights, dtype=float)
    if shares.shape != (len(found),) or not (np.isfinite(shares) & (shares > 0)).all():
        raise DeclarationError(
            f"an averaging frame needs one positive weight for each of its {len(found)} nodes: {weights!r}"
        )
    return Spider(found, "average", tuple(shares.tolist()), _place(place), _axes(axes))


def _place(place: Any) -> tuple[float, ...] | None:
    return None if place is None else tuple(_vectors(place, ((3,),), "the place of a frame is x, y, z in m").tolist())


def _axes(axes: Any) -> Array | None:
    """Rows x, y, z of length 1, from x, a vector in the plane of x and y, and z if given."""
    if axes is None:
        return None
    what = "axes of a frame are the directions of x, y and z as three vectors at right angles, or of x and y alone"
    rows = _vectors(axes, ((2, 3), (3, 3)), what)
    sizes = np.linalg.norm(rows, axis=1)
    if not sizes.all():
        raise DeclarationError(f"{what}, not {axes!r}")
    x, y, *z = rows / sizes[:, None]
    normal = np.cross(x, y)
    found = np.stack([x, np.cross(normal, x), normal])
    if np.linalg.norm(normal) <= SQUARE or (z and np.abs(np.stack([x, y, *z]) - found).max() > SQUARE):
        raise DeclarationError(f"{what}, not {axes!r}")
    return found / np.linalg.norm(found, axis=1)[:, None]


def _vectors(given: Any, shapes: tuple[tuple[int, ...], ...], what: str) -> Array:
    try:
        found = np.array(given, dtype=float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.shape not in shapes or not np.isfinite(found).all():
        raise DeclarationError(f"{what}, not {given!r}")
    return found


def indices(nodes: Any) -> tuple[int, ...]:
    """Return indices of nodes as a tuple, or refuse what are none."""
    array = np.atleast_1d(np.asarray(nodes))
    if array.ndim != 1 or not len(array) or not np.issubdtype(array.dtype, np.integer):
        raise DeclarationError(f"a frame needs the indices of its nodes, counted from 0, not {nodes!r}")
    return tuple(array.tolist())
