"""Torque: a torque between two frames."""

from __future__ import annotations

from acausal import Vector3, dot, input, structural
from components.frame import TwoFrames, torque_arrow
from components.orientation import resolve1, resolve2


class Torque(TwoFrames):
    """Torque that acts at frame_b, and in the opposite sense at frame_a."""

    torque: Vector3 = input("torque at frame_b, resolved in resolve_in_frame", unit="N.m")
    resolve_in_frame: str = structural(
        "where torque is resolved", default="frame_b", choices=("frame_b", "frame_a", "world")
    )

    def equations(self):
        a, b = self.frame_a, self.frame_b
        where = {"frame_a": a, "frame_b": b}.get(self.resolve_in_frame)
        torque_0 = self.torque if where is None else resolve1(where.R, self.torque)
        yield b.t == -(self.torque if where is b else resolve2(b.R, torque_0))
        yield a.t == (self.torque if where is a else resolve2(a.R, torque_0))
        yield a.f == (0, 0, 0)
        yield b.f == (0, 0, 0)

    def supplied_power(self):
        """Power of the torque at both frames."""
        a, b = self.frame_a, self.frame_b
        return -(dot(a.t, a.R.w) + dot(b.t, b.R.w))

    def shapes(self):
        """The torque at both frames."""
        yield from (torque_arrow(self.frame_b), torque_arrow(self.frame_a))
