"""Frame: connector of three-dimensional mechanics, and move(), the motion of one frame relative to another."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar

import numpy as np

from acausal import (
    Component,
    Connector,
    Vector3,
    as_expr,
    cross,
    der,
    flow,
    geometry,
    port,
    rooted,
    structural,
    variable,
)
from components.orientation import (
    Orientation,
    from_quaternion,
    quaternion_equations,
    resolve1,
    resolve2,
    skew,
)


class Frame(Connector):
    """Coordinate system fixed to a body, with position, velocity and acceleration, and the cut force and torque.

    Velocities and accelerations are relative to the world and resolved in this frame.
    """

    domain: ClassVar[str] = "multibody"
    start_words: ClassVar[dict[str, str]] = {
        "r_0": "r_0=fixed(...)",
        "v": "v_0=fixed(...)",
        "R.w": "w_a=fixed(...)",
        "Q": "angles_fixed=True",
    }
    turns: bool = structural("whether a free frame rotates", default=True, choices=(True, False))
    r_0: Vector3 = variable("position of the origin, resolved in the world", unit="m")
    R: Any = Orientation()
    v: Vector3 = variable("velocity of the origin, resolved in this frame", unit="m/s")
    a: Vector3 = variable("acceleration of the origin, resolved in this frame", unit="m/s2")
    z: Vector3 = variable("angular acceleration, resolved in this frame", unit="rad/s2")
    f: Vector3 = flow("cut force, resolved in this frame", unit="N")
    t: Vector3 = flow("cut torque, resolved in this frame", unit="N.m")
    Q: Any = variable("quaternion of a free frame", unit="1", shape=(4,), start=(0, 0, 0, 1), root=True)

    def declared_derivatives(self) -> Iterator[tuple[Any, Any]]:
        """Rigid-body kinematics, resolved in this frame."""
        yield self.r_0, resolve1(self.R, self.v)
        yield self.R.T, -skew(self.R.w) @ self.R.T
        yield self.v, self.a - cross(self.R.w, self.v)
        yield self.R.w, self.z

    def residual(self, other: Any) -> Iterator[tuple[Any, Any]]:
        """Closure equations: equal positions and orientations, with their reactions."""
        yield self.r_0 == other.r_0, resolve1(self.R, self.f)
        yield turn_between(self, other) == as_expr(np.zeros(3)), self.t

    def power(self) -> Iterator[tuple[Any, Any]]:
        """Conjugate pairs: force and velocity, torque and angular velocity."""
        yield self.v, self.f
        yield self.R.w, self.t

    def loop_kind(self, undetermined: tuple[str, ...]) -> str:
        """Name a loop by its undetermined reactions: planar, one force and two torques; spherical, three forces."""
        kinds = [name.rpartition(".")[2][0] for name in undetermined]
        return {"ftt": "planar loop", "fff": "spherical loop"}.get("".join(sorted(kinds)), "loop")

    def root_equations(self) -> Iterator[Any]:
        """Orientation by the quaternion of a free frame, or the axes of the world."""
        if self.turns:
            yield self.R.T == from_quaternion(self.Q).T
            yield from quaternion_equations(self.Q, self.R.w)
        else:
            yield np.eye(3) == self.R.T
            yield self.Q == (0, 0, 0, 1)


class TwoFrames(Component):
    """Base of components with two frames."""

    ends = ("frame_a", "frame_b")
    frame_a: Frame = port(Frame, "coordinate system at the first end")
    frame_b: Frame = port(Frame, "coordinate system at the second end")

    def shapes(self):
        """The parts, or a thin rod if no part has a frame."""
        parts = list(super().shapes())
        yield from parts
        if not any(isinstance(end, Frame) for part in parts for end in part._ports):
            yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0)


def turn_between(frame_a: Any, frame_b: Any) -> Any:
    """Rotation vector n tan(angle / 2) from frame_a to frame_b, equal in both frames; 0 for parallel frames only."""
    T = frame_b.R.T @ frame_a.R.T.T
    return as_expr((T[1, 2] - T[2, 1], T[2, 0] - T[0, 2], T[0, 1] - T[1, 0])) / (1 + T[0, 0] + T[1, 1] + T[2, 2])


def pose(frame: Any) -> geometry.Pose:
    """Position and orientation of shapes fixed to a frame."""
    return geometry.Pose(frame.r_0, frame.R.T)


def force_arrow(frame: Any) -> geometry.Arrow:
    """Force of a component on the parts connected to its frame."""
    return geometry.Arrow(frame.r_0, -resolve1(frame.R, frame.f))


def torque_arrow(frame: Any) -> geometry.Arrow:
    """Torque of a component on the parts connected to its frame."""
    return geometry.Arrow(frame.r_0, -resolve1(frame.R, frame.t), "torque")


def move(frame_a: Any, frame_b: Any, r: Any, R: Any, offset: Any = None) -> Iterator[Any]:
    """Equations of position, velocity and acceleration between two frames, directed away from the root.

    Parameters
    ----------
    frame_a, frame_b : Frame
        The two frames, related by a branch().
    r : Expr or array, shape (3,)
        Position of frame_b relative to frame_a, resolved in frame_a, in m.
    R : RelativeOrientation
        Orientation of frame_b relative to frame_a.
    offset : Expr, shape (3,), optional
        Quasi-static displacement of frame_b, resolved in frame_a, in m; enters the position only.

    Notes
    -----
    With dr, ddr the derivatives of r in frame_a, and T, w the rotation matrix and angular velocity of R:
    v_b = T (v_a + w_a x r + dr), z_b = T z_a + der(w) + (T w_a) x w,
    a_b = T (a_a + z_a x r + w_a x (w_a x r) + 2 w_a x dr + ddr).
    If frame_b is closer to the root, these equations are solved for the motion of frame_a. Formulating the motion of frame_a
    relative to frame_b instead would differentiate products of T and r, which doubles the operations if both depend on
    many coordinates.
    """
    a, b, w_a, dr = frame_a, frame_b, frame_a.R.w, _der(r)
    shifted = r if offset is None else r + offset
    along = cross(a.z, r) + cross(w_a, cross(w_a, r)) + 2 * cross(w_a, dr) + _der(dr)
    if rooted(a, b):
        yield b.r_0 == a.r_0 + resolve1(a.R, shifted)
        yield b.R.T == R.T @ a.R.T
        yield b.R.w == resolve2(R, w_a) + R.w
        yield b.v == resolve2(R, a.v + cross(w_a, r) + dr)
        yield b.z == resolve2(R, a.z) + cross(resolve2(R, w_a), R.w) + _der(R.w)
        yield b.a == resolve2(R, a.a + along)
    else:
        yield a.r_0 == b.r_0 - resolve1(a.R, shifted)
        yield a.R.T == R.T.T @ b.R.T
        yield w_a == resolve1(R, b.R.w - R.w)
        yield a.v == resolve1(R, b.v) - cross(w_a, r) - dr
        yield a.z == resolve1(R, b.z - cross(b.R.w, R.w) - _der(R.w))
        yield a.a == resolve1(R, b.a) - along


def _der(x: Any) -> Any:
    return np.zeros(3) if isinstance(x, np.ndarray) else der(x)
