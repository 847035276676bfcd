"""WorldTorque: an external torque at a frame."""

from __future__ import annotations

from acausal import Component, Vector3, dot, input, port, structural
from components.frame import Frame, torque_arrow
from components.orientation import resolve2


class WorldTorque(Component):
    """Torque from outside the model that acts at frame_b."""

    ends = ("frame_b", "frame_b")
    torque: Vector3 = input("torque, resolved in resolve_in_frame", unit="N.m")
    resolve_in_frame: str = structural("where torque is resolved", default="world", choices=("world", "frame_b"))
    frame_b: Frame = port(Frame, "where the torque acts")

    def equations(self):
        frame = self.frame_b
        yield frame.t == -(resolve2(frame.R, self.torque) if self.resolve_in_frame == "world" else self.torque)
        yield frame.f == (0, 0, 0)

    def supplied_power(self):
        """Power of the torque."""
        return -dot(self.frame_b.t, self.frame_b.R.w)

    def shapes(self):
        """The torque."""
        yield torque_arrow(self.frame_b)
