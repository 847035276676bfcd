"""Universal joint."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, Scalar, branch, der, dot, geometry, structural, variable
from components.frame import TwoFrames, move, pose
from components.orientation import absolute_rotation, planar_rotation, resolve1, unit_vector
from components.world import require_direction


class Universal(TwoFrames):
    """Universal joint: frame_b rotates relative to frame_a about n_a, then about n_b."""

    n_a: Any = structural("first axis, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length.")
    n_b: Any = structural("second axis, resolved in frame_b", default=(0, 1, 0), shape=(3,), doc="Any nonzero length.")
    phi_a: Scalar = variable("angle about n_a", unit="rad", select=PREFER)
    phi_b: Scalar = variable("angle about n_b", unit="rad", select=PREFER)
    w_a: Scalar = variable("der(phi_a)", unit="rad/s", select=PREFER)
    w_b: Scalar = variable("der(phi_b)", unit="rad/s", select=PREFER)
    a_a: Scalar = variable("der(w_a)", unit="rad/s2")
    a_b: Scalar = variable("der(w_b)", unit="rad/s2")

    def check(self) -> None:
        """Reject axes of length 0."""
        require_direction(self, self.n_a, "n_a")
        require_direction(self, self.n_b, "n_b")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        n_a, n_b = unit_vector(self.n_a), unit_vector(self.n_b)
        R = absolute_rotation(planar_rotation(n_a, self.phi_a), planar_rotation(n_b, self.phi_b))
        yield self.w_a == der(self.phi_a)
        yield self.w_b == der(self.phi_b)
        yield self.a_a == der(self.w_a)
        yield self.a_b == der(self.w_b)
        yield from move(self.frame_a, self.frame_b, (0, 0, 0), R)
        yield self.frame_a.f == -resolve1(R, self.frame_b.f)
        yield self.frame_a.t == -resolve1(R, self.frame_b.t)
        yield dot(n_a, self.frame_a.t) == 0
        yield dot(n_b, self.frame_b.t) == 0

    def shapes(self):
        """A pin along each axis."""
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n_a), style="pin")
        yield geometry.Axle(pose(self.frame_b), unit_vector(self.n_b), style="pin")
