"""Planar joint."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import PREFER, DeclarationError, Scalar, branch, cross, der, dot, geometry, structural, variable
from components.frame import TwoFrames, move, pose
from components.orientation import parallel, planar_rotation, resolve1, unit_vector
from components.world import require_direction


class Planar(TwoFrames):
    """Planar joint: frame_b translates in the plane of frame_a normal to n, and rotates about n."""

    n: Any = structural(
        "normal of the plane, the same in frame_a and frame_b", default=(0, 0, 1), shape=(3,), doc="Any nonzero length."
    )
    n_x: Any = structural(
        "direction of s_x, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Only its in-plane part is used."
    )
    s_x: Scalar = variable("distance from frame_a to frame_b along n_x", unit="m", select=PREFER)
    s_y: Scalar = variable("distance from frame_a to frame_b along n x n_x", unit="m", select=PREFER)
    phi: Scalar = variable("angle from frame_a to frame_b", unit="rad", select=PREFER)
    v_x: Scalar = variable("der(s_x)", unit="m/s", select=PREFER)
    v_y: Scalar = variable("der(s_y)", unit="m/s", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a_x: Scalar = variable("der(v_x)", unit="m/s2")
    a_y: Scalar = variable("der(v_y)", unit="m/s2")
    wd: Scalar = variable("der(w)", unit="rad/s2")

    def check(self) -> None:
        """Reject directions of length 0, and parallel ones."""
        require_direction(self, self.n, "n")
        require_direction(self, self.n_x, "n_x")
        if parallel(self.n, self.n_x):
            raise DeclarationError(
                "`n_x` is parallel to `n`; give a direction in the plane, for instance n_x=(1, 0, 0)."
            )

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        n = unit_vector(self.n)
        e_y = unit_vector(np.cross(n, self.n_x))
        e_x = np.cross(e_y, n)
        r, R = e_x * self.s_x + e_y * self.s_y, planar_rotation(n, self.phi)
        f_b = resolve1(R, self.frame_b.f)
        yield self.v_x == der(self.s_x)
        yield self.v_y == der(self.s_y)
        yield self.w == der(self.phi)
        yield self.a_x == der(self.v_x)
        yield self.a_y == der(self.v_y)
        yield self.wd == der(self.w)
        yield from move(self.frame_a, self.frame_b, r, R)
        yield self.frame_a.f == -f_b
        yield self.frame_a.t == -resolve1(R, self.frame_b.t) - cross(r, f_b)
        yield dot(e_x, f_b) == 0
        yield dot(e_y, f_b) == 0
        yield dot(n, self.frame_b.t) == 0

    def shapes(self):
        """A pin at frame_b."""
        yield geometry.Axle(pose(self.frame_b), unit_vector(self.n))
