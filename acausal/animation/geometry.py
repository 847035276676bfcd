"""Shapes of parts in animations: points, axes and lengths, without mechanics.

Quantities that are resolved in the world may vary with time: they are expressions of variables, as in an equation, or numbers.
Sizes and quantities that are resolved in a pose are constant, except for the center of a Box or Sphere: they are numbers or
expressions of parameters. A size that is None takes a default that suits the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, get_args

RailStyle = Literal["guide", "shaft", "screw"]
SolidStyle = Literal["plain", "link", "wheel", RailStyle]
JointStyle = Literal["hinge", "pin", "ball", "block", "sleeve", "gear", "rotor", "support"]
SpanStyle = Literal["rod", "rail", "coil", "damper", "rope"]
Quantity = Literal["force", "torque"]
Profile = Literal["ellipse", "rectangle"]
QUANTITIES, PROFILES = get_args(Quantity), get_args(Profile)


@dataclass(frozen=True, eq=False)
class Pose:
    """Position and orientation of a rigid shape.

    Parameters
    ----------
    r : shape (3,)
        Position of the origin of its axes, resolved in the world, in m.
    T : shape (3, 3)
        Rotation matrix from the world to its axes.
    """

    r: Any
    T: Any


@dataclass(frozen=True, eq=False)
class Ground:
    """Grid through the origin of the world, normal to `up` (3,), resolved in the world; None stands for +y."""

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
    """Solid of revolution between two points (3,), resolved in the pose: a plain cylinder, or in another style."""

    pose: Pose
    start: Any
    end: Any
    diameter: Any = None
    style: SolidStyle = "plain"


@dataclass(frozen=True, eq=False)
class Sphere:
    """Sphere about a point (3,), resolved in the pose."""

    pose: Pose
    center: Any = (0, 0, 0)
    diameter: Any = None


@dataclass(frozen=True, eq=False)
class Axle:
    """Part of a joint along an axis (3,), centred in the pose and resolved in it.

    An axis of None is that of the joint at the same point, else of the shape that begins there, else vertical.
    """

    pose: Pose
    axis: Any
    length: Any = None
    diameter: Any = None
    style: JointStyle = "hinge"


@dataclass(frozen=True, eq=False)
class Rail:
    """Rail through the pose along an axis (3,), resolved in it, as long as the path of a point `to` (3,) of the world."""

    pose: Pose
    axis: Any
    to: Any
    style: RailStyle = "guide"


@dataclass(frozen=True, eq=False)
class Span:
    """Rod, rail, coil, damper or rope between two moving points (3,), resolved in the world."""

    start: Any
    end: Any
    style: SpanStyle = "rod"
    diameter: Any = None


@dataclass(frozen=True, eq=False)
class Trail:
    """Path of a point (3,), resolved in the world."""

    at: Any


@dataclass(frozen=True, eq=False)
class Arrow:
    """Vector (3,) at a point (3,), both resolved in the world."""

    at: Any
    vector: Any
    quantity: Quantity = "force"


@dataclass(frozen=True, eq=False)
class Values:
    """Values to colour a curve by: one entry for each point, or a function that returns these and is called on request."""

    name: str
    unit: str
    entries: Any


@dataclass(frozen=True, eq=False)
class Curve:
    """Tube along a curve, cubic between its points.

    Parameters
    ----------
    points : shape (n, 3)
        Points, resolved in the world, in m.
    tangents : shape (n, 3), optional
        Derivatives with respect to a parameter that grows by 1 from each point to the next; by default of a smooth curve.
    section : pair, or shape (n, 2)
        Half-axes of the section along `up` x tangent and along `up`, in m, of all points or of each, linear between them; None
        for a default that suits the scene.
    up : shape (3,) or (n, 3), optional
        Direction of the second half-axis, resolved in the world: at the first point, from where it continues without twist, or
        at each point.
    profile : str
        Section between the half-axes: "ellipse" or "rectangle".
    rest : Pose, optional
        Pose of the undeformed curve, with `rest_points`. Deformations are measured from the chord if it is None, or if another
        shape is attached to the end that moves relative to it.
    rest_points : shape (n, 3), optional
        Undeformed points, resolved in `rest`; their distances from the first one also divide the chord.
    values : sequence of Values
        Values to colour the curve by.
    """

    points: Any
    tangents: Any = None
    section: Any = (None, None)
    up: Any = None
    profile: Profile = "ellipse"
    rest: Pose | None = None
    rest_points: Any = None
    values: Sequence[Values] = ()


@dataclass(frozen=True, eq=False)
class Mesh:
    """Surface of a body that deforms by modes.

    Parameters
    ----------
    pose : Pose
        Pose of the body.
    vertices : array, shape (n, 3)
        Undeformed vertices, resolved in the pose, in m.
    triangles : array of int, shape (m, 3)
        Rows of `vertices`, anticlockwise from outside.
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


Shape = Ground | Box | Cylinder | Sphere | Axle | Rail | Span | Trail | Arrow | Curve | Mesh
STYLES: dict[type, tuple[str, ...]] = {
    Cylinder: get_args(SolidStyle),
    Axle: get_args(JointStyle),
    Rail: get_args(RailStyle),
    Span: get_args(SpanStyle),
}
