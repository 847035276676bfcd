"""FixedRotation: rigid massless connection with a translation and a rotation."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, Vector3, branch, cross, geometry, parameter, structural
from components.frame import TwoFrames, move, pose
from components.orientation import (
    axes_rotations,
    axis_rotation,
    fixed_rotation,
    parallel,
    resolve1,
    two_axes_rotation,
    unit_vector,
)
from components.world import require_direction


class FixedRotation(TwoFrames):
    """Frame_b is fixed at r from frame_a, with a constant relative rotation."""

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m", default=(0, 0, 0))
    n: Any = structural(
        "axis of rotation, the same in frame_a and frame_b", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    angle: Any = structural("angle of rotation about n, in rad", default=0.0, shape=(), doc="From frame_a to frame_b.")
    rotation_type: str = structural(
        "specification of the rotation",
        default="axis",
        choices=("axis", "two_axes", "sequence"),
        doc="axis: n and angle; two_axes: n_x and n_y; sequence: angles about the axes of sequence.",
    )
    n_x: Any = structural("x-axis of frame_b, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="two_axes.")
    n_y: Any = structural(
        "direction in the xy plane of frame_b, resolved in frame_a", default=(0, 1, 0), shape=(3,), doc="two_axes."
    )
    sequence: Any = structural("rotation axes, 1, 2 or 3", default=(1, 2, 3), shape=(3,), doc="sequence.")
    angles: Any = structural(
        "angles in rad, each about the rotated axis", default=(0, 0, 0), shape=(3,), doc="sequence."
    )

    def check(self) -> None:
        """Reject directions of length 0, parallel axes, and invalid axis numbers."""
        for name in {"axis": ("n",), "two_axes": ("n_x", "n_y")}.get(self.rotation_type, ()):
            require_direction(self, getattr(self, name), name)
        if self.rotation_type == "two_axes" and parallel(self.n_x, self.n_y):
            raise DeclarationError("`n_x` and `n_y` are parallel; give n_y another direction, such as n_y=(0, 1, 0).")
        if self.rotation_type == "sequence" and not set(self.sequence) <= {1, 2, 3}:
            raise DeclarationError(
                f"`sequence` is {tuple(self.sequence)}; give axes 1, 2 or 3, such as sequence=(1, 2, 3)."
            )

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        R = fixed_rotation(self._matrix())
        f_b, t_b = resolve1(R, b.f), resolve1(R, b.t)
        yield from move(a, b, self.r, R)
        yield a.f + f_b == (0, 0, 0)
        yield a.t + t_b + cross(self.r, f_b) == (0, 0, 0)

    def shapes(self):
        """A link."""
        yield geometry.Cylinder(pose(self.frame_a), (0, 0, 0), self.r, style="link")

    def _matrix(self) -> np.ndarray:
        if self.rotation_type == "two_axes":
            return two_axes_rotation(self.n_x, self.n_y)
        if self.rotation_type == "sequence":
            return axes_rotations(self.sequence, self.angles)
        return axis_rotation(unit_vector(self.n), float(self.angle))
