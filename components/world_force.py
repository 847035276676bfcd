"""WorldForce: an external force at a frame."""

from __future__ import annotations

from acausal import Component, Vector3, dot, input, port, structural
from components.frame import Frame, force_arrow
from components.orientation import resolve2


class WorldForce(Component):
    """Force from outside the model that acts at the origin of frame_b."""

    ends = ("frame_b", "frame_b")
    force: Vector3 = input("force, resolved in resolve_in_frame", unit="N")
    resolve_in_frame: str = structural("where force is resolved", default="world", choices=("world", "frame_b"))
    frame_b: Frame = port(Frame, "where the force acts")

    def equations(self):
        frame = self.frame_b
        yield frame.f == -(resolve2(frame.R, self.force) if self.resolve_in_frame == "world" else self.force)
        yield frame.t == (0, 0, 0)

    def supplied_power(self):
        """Power of the force."""
        return -dot(self.frame_b.f, self.frame_b.v)

    def shapes(self):
        """The force."""
        yield force_arrow(self.frame_b)
