"""Kinds of geometry that parts say they look like: points, axes and lengths, and nothing of mechanics.

What is resolved in the world may vary with time: expressions of variables, as in an equation, or numbers. What is resolved
in a pose and sizes do not, but for the center of a Box or Sphere: numbers, or expressions of parameters; a size that is None
suits the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, get_args

Style = Literal["coil", "rod", "rail"]
Quantity = Literal["force", "torque"]
STYLES, QUANTITIES = get_args(Style), get_args(Quantity)


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a rigid shape is.

    Parameters
    ----------
    r : shape (3,)
        Position of the origin of its axes, resolved in the world, in m.
    T : shape (3, 3)
        Rotation matrix from the world to these axes.
    """

    r: Any
    T: Any


@dataclass(frozen=True, eq=False)
class Ground:
    """Grid through the origin of the world, normal to `up` (3,), resolved in the world; None is along +y."""

    up: Any = None


@dataclass(frozen=True, eq=False)
class Box:
    """Box with its center (3,) and unit vectors along length, width and height (3, 3), rows, resolved in the pose."""

    pose: Pose
    center: Any
    size: Any
    axes: Any = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True, eq=False)
class Cylinder:
    """Cylinder between two points (3,), resolved in the pose."""

    pose: Pose
    start: Any
    end: Any
    diameter: Any = None


@dataclass(frozen=True, eq=False)
class Sphere:
    """Sphere about a point (3,), resolved in the pose."""

    pose: Pose
    center: Any = (0, 0, 0)
    diameter: Any = None


@dataclass(frozen=True, eq=False)
class Axle:
    """Pin along an axis (3,), centred in the pose and resolved in it."""

    pose: Pose
    axis: Any
    length: Any = None
    diameter: Any = None


@dataclass(frozen=True, eq=False)
class Span:
    """What spans two moving points (3,), resolved in the world."""

    start: Any
    end: Any
    style: Style = "rod"
    diameter: Any = None


@dataclass(frozen=True, eq=False)
class Arrow:
    """Vector (3,) at a point (3,), both resolved in the world."""

    at: Any
    vector: Any
    quantity: Quantity = "force"


@dataclass(frozen=True, eq=False)
class Values:
    """A quantity along a curve, by which it is coloured: one entry for each point, or a function that makes them if asked."""

    name: str
    unit: str
    entries: Any


@dataclass(frozen=True, eq=False)
class Curve:
    """Tube along a curve, cubic between its points.

    Parameters
    ----------
    points : shape (n, 3)
        Resolved in the world, in m.
    tangents : shape (n, 3), optional
        Derivatives by a parameter that grows by 1 from each point to the next; None lets the curve pass smoothly.
    section : pair
        Half-axes of its ellipse along `up` x tangent and along `up`, in m; None suits the scene.
    up : shape (3,), optional
        Direction of the second half-axis at the first point, resolved in the world.
    rest : Pose, optional
        Where it is undeformed, with `rest_points`. Deformations are measured from the chord where it is None, and where
        something else stands at the end that is not at rest.
    rest_points : shape (n, 3), optional
        Undeformed points, resolved in `rest`; for the chord their distances from the first count.
    values : sequence of Values
        By which it can be coloured.
    """

    points: Any
    tangents: Any = None
    section: Any = (None, None)
    up: Any = None
    rest: Pose | None = None
    rest_points: Any = None
    values: Sequence[Values] = ()


@dataclass(frozen=True, eq=False)
class Mesh:
    """Skin of a body, which deforms by modes.

    Parameters
    ----------
    pose : Pose
        Its axes.
    vertices : array, shape (n, 3)
        Undeformed, resolved in the pose, in m.
    triangles : array of int, shape (m, 3)
        Outward anticlockwise.
    modes : array, shape (k, n, 3), optional
        Displacements of the vertices for unit coordinates, resolved in the pose.
    q : shape (k,), optional
        Modal coordinates.
    """

    pose: Pose
    vertices: Any
    triangles: Any
    modes: Any = None
    q: Any = None


Shape = Ground | Box | Cylinder | Sphere | Axle | Span | Arrow | Curve | Mesh
