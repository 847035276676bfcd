"""Fixed: frame fixed in the world."""

from __future__ import annotations

import numpy as np

from acausal import Component, Vector3, geometry, parameter, port, root
from components.frame import Frame, pose


class Fixed(Component):
    """Frame_b is fixed at r, with the axes of the world."""

    ends = ("", "frame_b")
    r: Vector3 = parameter("position of frame_b, resolved in the world", unit="m", default=(0, 0, 0))
    frame_b: Frame = port(Frame, "the fixed frame")

    def connections(self):
        yield root(self.frame_b)

    def equations(self):
        frame, zero = self.frame_b, np.zeros(3)
        yield frame.r_0 == self.r
        yield np.eye(3) == frame.R.T
        yield frame.R.w == zero
        yield frame.v == zero
        yield frame.a == zero
        yield frame.z == zero

    def shapes(self):
        """A support."""
        yield geometry.Axle(pose(self.frame_b), None, style="support")
