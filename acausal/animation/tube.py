"""Place the sections of a tube along a curve."""

from __future__ import annotations

import numpy as np

from acausal.animation import geometry as g
from acausal.animation.scene import chord_fractions, in_world

PIECES = 10  # straight pieces of a cubic
OPPOSITE = 1e-9  # least sum of 1 and the cosine between a tangent and a deformed one


def sections(curve: g.Curve, k: int, deformation: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the sections of frame k of an evaluated curve: their centres and their half-axes, resolved in the world, in m.

    Parameters
    ----------
    curve : Curve
        Curve with arrays in place of expressions, and with default sizes.
    k : int
        Number of the frame.
    deformation : float
        Scale of the deformation; the sections turn with the tangents.

    Returns
    -------
    array, shape (m, 3)
        Centres, PIECES between two points of the curve.
    array, shape (m, 2, 3)
        Half-axes along `up` x tangent and along `up`.
    """
    rest, up = _undeformed(curve, k), None if curve.up is None else curve.up[k]
    points = rest + deformation * (curve.points[k] - rest)
    slope = np.gradient(rest, axis=0)
    tangents = slope + deformation * (curve.tangents[k] - slope)
    if up is not None:
        up = _carried(up, _unit(curve.tangents[k][: len(up)]), _unit(tangents[: len(up)]))
    x = np.linspace(0, 1, PIECES + 1)[:, None, None]
    a, b = (2 * x - 3) * x * x + 1, (x - 2) * x * x + x
    axis = a * points[:-1] + (1 - a) * points[1:] + b * tangents[:-1] + (x - 1) * x * x * tangents[1:]
    da, db = 6 * x * (x - 1), (1 - x) * (1 - 3 * x)
    along = da * (points[:-1] - points[1:]) + db * tangents[:-1] + x * (3 * x - 2) * tangents[1:]
    along = _unit(_joined(along))
    place = np.linspace(0, len(points) - 1, len(along))
    if up is None or len(up) == 1:
        second = _continued(np.eye(3)[int(np.argmin(np.abs(along[0])))] if up is None else up[0], along)
    else:
        second = _normal(_between(up, place), along)
    axes = np.stack([np.cross(second, along), second], axis=1)
    return _joined(axis), _between(np.asarray(curve.section), place)[:, :, None] * axes


def half_widths(profile: g.Profile, half_axes: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Return half the widths of sections, shape (m,), seen along their half-axes (m, 2, 3) in the directions (m, 3), in m."""
    parts = np.einsum("kij,kj->ki", half_axes, across)
    return np.abs(parts).sum(axis=1) if profile == "rectangle" else np.linalg.norm(parts, axis=1)


def _undeformed(curve: g.Curve, k: int) -> np.ndarray:
    """Return the undeformed points of a curve, in the world."""
    if curve.rest is not None:
        return in_world(g.Pose(curve.rest.r[k : k + 1], curve.rest.T[k : k + 1]), curve.rest_points)[0]
    first, last = curve.points[k, 0], curve.points[k, -1]
    return first + np.array(chord_fractions(curve))[:, None] * (last - first)


def _joined(pieces: np.ndarray) -> np.ndarray:
    """Return the rows of all cubics in turn, without the repeated ends: from (PIECES + 1, n, 3) to (n PIECES + 1, 3)."""
    return np.concatenate([pieces[:-1].transpose(1, 0, 2).reshape(-1, 3), pieces[-1, -1:]])


def _between(rows: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Return rows interpolated linearly at places in numbers of rows; a single row everywhere."""
    return np.stack([np.interp(place, np.arange(len(rows)), column) for column in rows.T], axis=1)


def _unit(v: np.ndarray) -> np.ndarray:
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    return v / np.where(size > 0, size, 1)


def _normal(v: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return unit vectors normal to unit vectors, nearest to v."""
    return _unit(v - np.sum(v * along, axis=-1, keepdims=True) * along)


def _continued(up: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return directions that continue without twist along a line."""
    found = []
    for direction in along:
        up = _normal(up, direction)
        found.append(up)
    return np.array(found)


def _carried(v: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Turn vectors as the shortest rotations between unit vectors do."""
    axis = np.cross(start, end)
    turned = np.cross(axis, v)
    cosine = np.sum(start * end, axis=-1, keepdims=True)
    return v + turned + np.cross(axis, turned) / np.maximum(1 + cosine, OPPOSITE)
