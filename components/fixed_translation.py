"""FixedTranslation: rigid massless rod between two frames."""

from __future__ import annotations

from acausal import Vector3, branch, cross, geometry, parameter
from components.frame import TwoFrames, move, pose
from components.orientation import null_rotation


class FixedTranslation(TwoFrames):
    """Frame_b is fixed at r from frame_a, with the same axes."""

    r: Vector3 = parameter("from frame_a to frame_b, resolved in frame_a", unit="m")

    def connections(self):
        yield branch(self.frame_a, self.frame_b)

    def equations(self):
        a, b = self.frame_a, self.frame_b
        yield from move(a, b, self.r, null_rotation())
        yield a.f + b.f == (0, 0, 0)
        yield a.t + b.t + cross(self.r, b.f) == (0, 0, 0)

    def shapes(self):
        """A link."""
        yield geometry.Cylinder(pose(self.frame_a), (0, 0, 0), self.r, style="link")
