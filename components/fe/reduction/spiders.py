"""Spiders: node sets that define a frame, rigid (RBE2) or averaging (RBE3), with its position and axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError
from components.fe.arrays import Array

# Deviation of given axes from right angles: they have six or seven digits.
SQUARE = 1e-5


@dataclass(frozen=True)
class Spider:
    """Nodes that define a frame; see `frame_at`, `rigid` and `average`.

    Parameters
    ----------
    nodes : tuple of int
        Rows of the nodes.
    kind : str
        "rigid", "average", or "" (fixed or averaged, depending on `hold`).
    weights : tuple of float, optional
        Weight of each node; by default the area weights of the faces that the nodes span.
    place : tuple of 3 floats, optional
        Position in m; by default the weighted mean of the nodes.
    axes : array, shape (3, 3), optional
        Axes x, y, z of the frame as rows; by default those of the node coordinates.
    """

    nodes: tuple[int, ...]
    kind: str = ""
    weights: tuple[float, ...] | None = None
    place: tuple[float, ...] | None = None
    axes: Array | None = None


def frame_at(nodes: Any, place: Any = None, axes: Any = None) -> Spider:
    """Give a frame a position and axes; its nodes are fixed or averaged as those of a plain frame.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    place : 3 floats, optional
        Position of the frame in m, in node coordinates, such as the centre of a hole. By default the mean of the nodes,
        weighted by the area of the faces that they span.
    axes : 2 or 3 vectors, optional
        Direction of x, a vector in the x-y plane, and optionally z, in node coordinates. By default the axes of the
        coordinates.

    Raises
    ------
    DeclarationError
        If the position is not a vector, or the axes are not right-handed.

    Examples
    --------
    >>> frames = {"hinge": frame_at([0, 2, 4], place=(0, 0, 0), axes=((0, 0, 1), (1, 0, 0)))}
    """
    return Spider(indices(nodes), "", None, _place(place), _axes(axes))


def rigid(nodes: Any, *, place: Any = None, axes: Any = None) -> Spider:
    """Make a rigid spider (RBE2): its nodes move as one rigid body, which stiffens the body there.

    Use it for faces welded to another body: a joint of two averaging frames is softer than the material.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    place, axes : optional
        See `frame_at`.
    """
    return Spider(indices(nodes), "rigid", None, _place(place), _axes(axes))


def average(nodes: Any, weights: Any = None, *, place: Any = None, axes: Any = None) -> Spider:
    """Make an averaging spider (RBE3): the frame follows the mean of its nodes, without stiffening the body.

    The displacement at the mean position is the mean of the nodal displacements u, and the rotation is the
    least-squares fit Psi = (sum w (|d|^2 E - d d'))^-1 sum w d x u, with d the vectors from the mean position to the
    nodes. Forces on the frame are distributed over the nodes with the same weights.

    Parameters
    ----------
    nodes : sequence of int
        Nodes, counted from 0.
    weights : sequence of float, optional
        Positive weight w of each node. By default the integral of its shape function over the faces that the nodes
        span, so that a force acts as a uniform pressure; equal weights if no faces are known.
    place, axes : optional
        See `frame_at`.

    Raises
    ------
    DeclarationError
        If the number of weights differs from that of the nodes, or a weight is not positive.
    """
    found = indices(nodes)
    if weights is None:
        return Spider(found, "average", None, _place(place), _axes(axes))
    shares = np.asarray(weights, dtype=float)
    if shares.shape != (len(found),) or not (np.isfinite(shares) & (shares > 0)).all():
        raise DeclarationError(
            f"weights must be one positive number for each of the {len(found)} nodes, not {weights!r}"
        )
    return Spider(found, "average", tuple(shares.tolist()), _place(place), _axes(axes))


def _place(place: Any) -> tuple[float, ...] | None:
    return (
        None if place is None else tuple(_vectors(place, ((3,),), "the place of a frame must be x, y, z in m").tolist())
    )


def _axes(axes: Any) -> Array | None:
    """Return orthonormal rows x, y, z from x, a vector in the x-y plane, and optionally z."""
    if axes is None:
        return None
    what = "the axes of a frame must be orthogonal vectors along x, y and z, or x and a vector in the x-y plane"
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
    """Return node indices as a tuple; DeclarationError if they are not integers."""
    array = np.atleast_1d(np.asarray(nodes))
    if array.ndim != 1 or not len(array) or not np.issubdtype(array.dtype, np.integer):
        raise DeclarationError(f"the nodes of a frame must be indices counted from 0, not {nodes!r}")
    return tuple(array.tolist())
