"""Constant-velocity joint."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, branch, der, dot, geometry, structural, variable
from components.frame import TwoFrames, move, pose
from components.orientation import across, resolve1, rodrigues_rate, rodrigues_rotation, unit_vector
from components.world import require_direction


class ConstantVelocityJoint(TwoFrames):
    """Constant-velocity joint: frame_b inclines to frame_a in any direction and spins about n at the speed of frame_a.

    Notes
    -----
    Frame_b is rotated relative to frame_a about an axis perpendicular to n, by less than half a turn. The plane that
    transmits the rotation bisects the angle between the shafts (homokinetic plane), so that both speeds are equal at any
    angle. The torque at frame_b has no bending component: it is parallel to the bisector of both shafts.
    """

    n: Any = structural(
        "axis of the shafts, the same in frame_a and frame_b", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    theta: Any = variable(
        "rotation vector of length 2 tan(angle / 2), along two perpendicular directions normal to n",
        unit="rad",
        shape=(2,),
        select=PREFER,
    )
    w: Any = variable("der(theta)", unit="rad/s", shape=(2,), select=PREFER)
    a: Any = variable("der(w)", unit="rad/s2", shape=(2,))

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        e_1, e_2 = across(unit_vector(self.n))
        theta = e_1 * self.theta[0] + e_2 * self.theta[1]
        R = rodrigues_rotation(theta)
        bending = rodrigues_rate(theta).T @ self.frame_b.t
        yield self.w == der(self.theta)
        yield self.a == der(self.w)
        yield from move(self.frame_a, self.frame_b, (0, 0, 0), R)
        yield self.frame_a.f == -resolve1(R, self.frame_b.f)
        yield self.frame_a.t == -resolve1(R, self.frame_b.t)
        yield dot(e_1, bending) == 0
        yield dot(e_2, bending) == 0

    def shapes(self):
        """The end of each shaft."""
        yield geometry.Axle(pose(self.frame_a), unit_vector(self.n), style="pin")
        yield geometry.Axle(pose(self.frame_b), unit_vector(self.n), style="pin")
