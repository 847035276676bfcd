"""Revolute joint."""

from __future__ import annotations

from typing import Any

from acausal import PREFER, Scalar, branch, der, dot, port, structural, variable
from components.flange import Flange
from components.frame import TwoFrames, move
from components.orientation import planar_rotation, resolve1, unit_vector
from components.world import require_direction


class Revolute(TwoFrames):
    """Revolute joint: frame_b turns relative to frame_a about the axis n.

    Parameters
    ----------
    n : array of 3 floats
        Axis of rotation, the same in frame_a and frame_b; any length but 0.
    use_axis_flange : bool
        True gives the joint a drive shaft `axis` and its housing `support`.
    """

    n: Any = structural("axis of rotation, the same in frame_a and frame_b", default=(0, 0, 1), shape=(3,))
    use_axis_flange: bool = structural("whether the joint has a drive shaft", default=False, choices=(True, False))
    phi: Scalar = variable("angle from frame_a to frame_b", unit="rad", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")
    tau: Scalar = variable("drive torque about n", unit="N.m")

    @port
    def axis(self):
        """Drive shaft."""
        return Flange() if self.use_axis_flange else None

    @port
    def support(self):
        """Housing of the drive."""
        return Flange() if self.use_axis_flange else None

    def check(self) -> None:
        """Refuse an axis of length 0."""
        require_direction(self, self.n, "n")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        n = unit_vector(self.n)
        R = planar_rotation(n, self.phi)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield from move(self.frame_a, self.frame_b, (0, 0, 0), R)
        yield self.frame_a.f == -resolve1(R, self.frame_b.f)
        yield self.frame_a.t == -resolve1(R, self.frame_b.t)
        yield self.tau == -dot(n, self.frame_b.t)
        if self.use_axis_flange:
            yield self.axis.phi == self.phi
            yield self.axis.tau == self.tau
            yield self.support.phi == 0
        else:
            yield self.tau == 0
