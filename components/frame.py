"""Frame: the connector of mechanics in three dimensions, and move(), which relates two of them."""

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
    """Coordinate system fixed to a body, with its motion at all levels and the cut force and torque.

    Velocities and accelerations are those of the origin relative to the world, resolved in this frame.
    """

    domain: ClassVar[str] = "multibody"
    start_words: ClassVar[dict[str, str]] = {
        "r_0": "r_0=fixed(...)",
        "v": "v_0=fixed(...)",
        "R.w": "w_a=fixed(...)",
        "Q": "angles_fixed=True",
    }
    turns: bool = structural("whether a frame that nothing guides turns", default=True, choices=(True, False))
    r_0: Vector3 = variable("position of the origin, resolved in the world", unit="m")
    R: Any = Orientation()
    v: Vector3 = variable("velocity of the origin, resolved in this frame", unit="m/s")
    a: Vector3 = variable("acceleration of the origin, resolved in this frame", unit="m/s2")
    z: Vector3 = variable("angular acceleration, resolved in this frame", unit="rad/s2")
    f: Vector3 = flow("cut force, resolved in this frame", unit="N")
    t: Vector3 = flow("cut torque, resolved in this frame", unit="N.m")
    Q: Any = variable("quaternion of a free frame", unit="1", shape=(4,), start=(0, 0, 0, 1), root=True)

    def declared_derivatives(self) -> Iterator[tuple[Any, Any]]:
        """Motion of a rigid frame, resolved in its own axes."""
        yield self.r_0, resolve1(self.R, self.v)
        yield self.R.T, -skew(self.R.w) @ self.R.T
        yield self.v, self.a - cross(self.R.w, self.v)
        yield self.R.w, self.z

    def residual(self, other: Any) -> Iterator[tuple[Any, Any]]:
        """Equal position, and no turn of one frame from the other."""
        yield self.r_0 == other.r_0, resolve1(self.R, self.f)
        yield turn_between(self, other) == as_expr(np.zeros(3)), self.t

    def power(self) -> Iterator[tuple[Any, Any]]:
        """Force times velocity and torque times angular velocity."""
        yield self.v, self.f
        yield self.R.w, self.t

    def loop_kind(self, undetermined: tuple[str, ...]) -> str:
        """Planar: a force across the plane and the torques in it; spherical: the forces alone."""
        kinds = [name.rpartition(".")[2][0] for name in undetermined]
        return {"ftt": "planar loop", "fff": "spherical loop"}.get("".join(sorted(kinds)), "loop")

    def root_equations(self) -> Iterator[Any]:
        """Quaternion of a free frame, or the axes of the world."""
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
        """Its parts, or a thin rod where none of them has a frame."""
        parts = list(super().shapes())
        yield from parts
        if not any(isinstance(end, Frame) for part in parts for end in part._ports):
            yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0)


def turn_between(frame_a: Any, frame_b: Any) -> Any:
    """Rotation vector n tan(angle / 2) of frame_b from frame_a, the same in both, which is 0 where they are parallel alone."""
    T = frame_b.R.T @ frame_a.R.T.T
    return as_expr((T[1, 2] - T[2, 1], T[2, 0] - T[0, 2], T[0, 1] - T[1, 0])) / (1 + T[0, 0] + T[1, 1] + T[2, 2])


def pose(frame: Any) -> geometry.Pose:
    """Where shapes that are fixed to a frame are."""
    return geometry.Pose(frame.r_0, frame.R.T)


def force_arrow(frame: Any) -> geometry.Arrow:
    """Force that a component exerts at a frame of its own on what is connected there."""
    return geometry.Arrow(frame.r_0, -resolve1(frame.R, frame.f))


def torque_arrow(frame: Any) -> geometry.Arrow:
    """Torque that a component exerts at a frame of its own on what is connected there."""
    return geometry.Arrow(frame.r_0, -resolve1(frame.R, frame.t), "torque")


def move(frame_a: Any, frame_b: Any, r: Any, R: Any, offset: Any = None) -> Iterator[Any]:
    """Equations of all levels of motion of frame_b relative to frame_a, written away from the root.

    Parameters
    ----------
    frame_a, frame_b : Frame
        The two frames, joined by a branch().
    r : Expr or array, shape (3,)
        Position of frame_b relative to frame_a, resolved in frame_a, in m.
    R : RelativeOrientation
        Orientation of frame_b relative to frame_a.
    offset : Expr, shape (3,), optional
        Displacement of frame_b, resolved in frame_a, in m, so slow that it counts in the position alone.

    Notes
    -----
    With dr, ddr the derivatives of r seen from frame_a and T, w those of R:
    v_b = T (v_a + w_a x r + dr), z_b = T z_a + der(w) + (T w_a) x w,
    a_b = T (a_a + z_a x r + w_a x (w_a x r) + 2 w_a x dr + ddr).
    Where frame_b is nearer to the root, the same is solved for the motion of frame_a. The motion of frame_a relative to
    frame_b would hold products of T and r, whose derivatives take as many operations again where these depend on many
    coordinates.
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
