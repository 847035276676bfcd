"""Orientation objects, a rotation matrix with its angular velocity, and functions of these.

An orientation R of frame 2 relative to frame 1 contains `T`, which transforms coordinates from frame 1 to frame 2, and
`w`, the angular velocity of frame 2 relative to frame 1, resolved in frame 2. Names as in Modelica's MultiBody.Frames.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import Expr, Matrix33, Record, Vector3, as_expr, cos, cross, der, dot, feedback, sin, sqrt, variable


@dataclass(frozen=True)
class RelativeOrientation:
    """Orientation of one frame relative to another: rotation matrix T (3, 3) and angular velocity w (3,)."""

    T: Any
    w: Any


class Orientation(Record):
    """Orientation of a frame relative to the world."""

    T: Matrix33 = variable("rotation matrix from the world to this frame", unit="1", start=np.eye(3))
    w: Vector3 = variable("angular velocity, resolved in this frame", unit="rad/s")


# Entry of a unit vector or rotation matrix that counts as 0: round-off, such as cos(pi / 2) = 6e-17.
ROUNDING = 4 * np.finfo(float).eps


def unit_vector(n: Any) -> np.ndarray:
    """Return a numerical vector scaled to length 1, with round-off set to 0."""
    n = np.asarray(n, dtype=float)
    n = n / np.max(np.abs(n))  # avoids overflow and underflow of squares
    n = np.where(np.abs(n) < ROUNDING, 0.0, n)
    return n / np.linalg.norm(n)


def across(n: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return two perpendicular numerical unit vectors normal to the unit vector n."""
    e_y = unit_vector(np.cross(n, np.eye(3)[np.argmin(np.abs(n))]))
    return np.cross(e_y, n), e_y


def norm(v: Any) -> Any:
    """Length of a vector."""
    return sqrt(dot(v, v))


def parallel(a: Any, b: Any) -> bool:
    """True if two numerical directions are parallel within 1e-6 rad: a smaller angle is a user error."""
    return bool(np.linalg.norm(np.cross(unit_vector(a), unit_vector(b))) < 1e-6)


def skew(v: Any) -> Any:
    """Return the matrix S with S u = v x u."""
    return as_expr([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def resolve1(R: Any, v: Any) -> Any:
    """Transform a vector from frame 2 to frame 1: T' v."""
    return R.T.T @ v


def resolve2(R: Any, v: Any) -> Any:
    """Transform a vector from frame 1 to frame 2: T v."""
    return R.T @ v


def axis_matrix(n: Any, phi: Any) -> Any:
    """Return the rotation matrix of a rotation by the angle phi in rad about the numerical unit vector n, shape (3, 3)."""
    outer = np.outer(n, n)
    cross_n = np.cross(np.eye(3), n)  # skew(n)
    return outer + (np.eye(3) - outer) * cos(phi) - cross_n * sin(phi)


def planar_rotation(n: Any, phi: Any) -> RelativeOrientation:
    """Rotate by the angle phi about the axis n.

    Parameters
    ----------
    n : array of 3 floats
        Axis of rotation, the same in both frames, of length 1.
    phi : Expr
        Angle in rad.
    """
    return RelativeOrientation(axis_matrix(n, phi), n * der(phi))


def fixed_rotation(T: np.ndarray) -> RelativeOrientation:
    """Rotate by a constant matrix."""
    return RelativeOrientation(T, np.zeros(3))


def absolute_rotation(R1: Any, R_rel: Any) -> RelativeOrientation:
    """Orientation of frame 2, from that of frame 1 and that of frame 2 relative to frame 1."""
    return RelativeOrientation(R_rel.T @ R1.T, R_rel.T @ R1.w + R_rel.w)


def inverse_rotation(R: Any) -> RelativeOrientation:
    """Orientation of frame 1 relative to frame 2."""
    return RelativeOrientation(R.T.T, -(R.T.T @ R.w))


def null_rotation() -> RelativeOrientation:
    """Orientation of a frame relative to itself."""
    return fixed_rotation(np.eye(3))


def from_quaternion(Q: Any) -> RelativeOrientation:
    """Orientation of a quaternion Q = (vector part, scalar part), with w = G(Q) der(Q).

    Division by Q . Q keeps T a rotation when round-off or an iteration changes the norm of Q.
    """
    e, s = Q[:3], Q[3]
    T = (2 * (outer_product(e, e) - s * skew(e)) + (s * s - e @ e) * np.eye(3)) / (Q @ Q)
    dQ = der(Q)
    return RelativeOrientation(T, 2 * (s * dQ[:3] - dQ[3] * e - cross(e, dQ[:3])))


def rodrigues_rotation(theta: Any) -> RelativeOrientation:
    """Rotate by the angle 2 arctan(|theta| / 2) about theta, to first order by the vector theta; w = G(theta) der(theta).

    The Rodrigues vector is p = theta / 2, the quaternion (p, 1) / sqrt(1 + p . p): only half a turn is singular, and there
    are no trigonometric functions. The generalised force of a torque t, resolved in frame 2, on theta is G' t
    (`rodrigues_rate`).

    Parameters
    ----------
    theta : Expr, shape (3,)
        Rotation vector in rad, the same in both frames.
    """
    p = theta / 2
    T = (2 * (outer_product(p, p) - skew(p)) + (1 - p @ p) * np.eye(3)) / (1 + p @ p)
    return RelativeOrientation(T, rodrigues_rate(theta) @ der(theta))


def rodrigues_rate(theta: Any) -> Any:
    """Matrix G with w = G der(theta) of `rodrigues_rotation`, w resolved in frame 2."""
    p = theta / 2
    return (np.eye(3) - skew(p)) / (1 + p @ p)


def outer_product(a: Any, b: Any) -> Any:
    """Return the matrix a b'."""
    return as_expr([[a[i] * b[j] for j in range(3)] for i in range(3)])


def quaternion_rate(Q: Any, w: Any) -> tuple[Expr, Expr]:
    """Vector and scalar part of der(Q) for an angular velocity w resolved in the rotated frame."""
    e, s = Q[:3], Q[3]
    return 0.5 * (s * w + cross(e, w)), -0.5 * (e @ w)


def quaternion_equations(Q: Any, w: Any) -> Iterator[Any]:
    """Differential equations of a quaternion; the feedback stabilises its norm at 1 (Baumgarte)."""
    e, s = quaternion_rate(Q, w)
    back = feedback * (1 - Q @ Q)
    yield der(Q[:3]) == e + back * Q[:3]
    yield der(Q[3]) == s + back * Q[3]


def quaternion_of(T: np.ndarray) -> np.ndarray:
    """Return the quaternion (vector part, scalar part) of a numerical rotation matrix."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(np.asarray(T).T).as_quat(canonical=True)


def axes_rotations(sequence: Any, angles: Any) -> np.ndarray:
    """Numerical rotation matrix of three successive rotations about the rotated axes 1, 2 or 3 of `sequence`."""
    T = np.eye(3)
    for axis, angle in zip(sequence, angles, strict=True):
        T = axis_rotation(np.eye(3)[int(axis) - 1], angle) @ T
    return T


def axis_rotation(n: Any, angle: float) -> np.ndarray:
    """Numerical rotation matrix of a rotation by `angle` in rad about the unit vector n, with round-off set to 0."""
    outer = np.outer(n, n)
    T = outer + (np.eye(3) - outer) * np.cos(angle) - np.cross(np.eye(3), n) * np.sin(angle)
    return np.where(np.abs(T) < ROUNDING, 0.0, T)


def two_axes_rotation(n_x: Any, n_y: Any) -> np.ndarray:
    """Numerical rotation matrix from the x-axis of the rotated frame and a direction in its xy plane."""
    e_x = unit_vector(n_x)
    e_z = unit_vector(np.cross(e_x, unit_vector(n_y)))
    T = np.array([e_x, np.cross(e_z, e_x), e_z])
    return np.where(np.abs(T) < ROUNDING, 0.0, T)
