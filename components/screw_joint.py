"""Screw joint."""

from __future__ import annotations

from math import pi

from acausal import Scalar, cross, der, dot, geometry, parameter, variable
from components.frame import move, pose
from components.orientation import planar_rotation, resolve1, unit_vector
from components.revolute import Revolute


class ScrewJoint(Revolute):
    """Screw joint: frame_b rotates about the axis n and advances along it by `pitch` per turn.

    Notes
    -----
    s = pitch phi / (2 pi). A positive pitch is a right-handed thread; there is no backlash. The drive rotates frame_b.
    """

    pitch: Scalar = parameter("advance along n per turn", unit="m")
    s: Scalar = variable("distance from frame_a to frame_b along n", unit="m")
    v: Scalar = variable("der(s)", unit="m/s")

    def equations(self):
        a, b, n = self.frame_a, self.frame_b, unit_vector(self.n)
        lead = self.pitch / (2 * pi)
        r, R = n * (lead * self.phi), planar_rotation(n, self.phi)
        f_b = resolve1(R, b.f)
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.s == lead * self.phi
        yield self.v == lead * self.w
        yield from move(a, b, r, R)
        yield a.f == -f_b
        yield a.t == -resolve1(R, b.t) - cross(r, f_b)
        yield self.tau - self.friction_load(self._drag()) == -dot(n, b.t) - lead * dot(n, b.f)
        yield from self.drive()

    def shapes(self):
        """A screw, a nut on it, and the torque of a drive."""
        n = unit_vector(self.n)
        yield geometry.Rail(pose(self.frame_a), n, self.frame_b.r_0, "screw")
        yield geometry.Axle(pose(self.frame_b), n, style="block")
        yield from self.drive_arrow()
