"""Force: a force between two frames."""

from __future__ import annotations

from acausal import Vector3, cross, dot, input, structural
from components.frame import TwoFrames, force_arrow, torque_arrow
from components.orientation import resolve1, resolve2


class Force(TwoFrames):
    """Force that acts at the origin of frame_b, and in the opposite sense, on the same line, on frame_a."""

    force: Vector3 = input("force at frame_b, resolved in resolve_in_frame", unit="N")
    resolve_in_frame: str = structural(
        "where force is resolved", default="frame_b", choices=("frame_b", "frame_a", "world")
    )

    def equations(self):
        a, b = self.frame_a, self.frame_b
        where = {"frame_a": a, "frame_b": b}.get(self.resolve_in_frame)
        force_0 = self.force if where is None else resolve1(where.R, self.force)
        yield b.f == -(self.force if where is b else resolve2(b.R, force_0))
        yield b.t == (0, 0, 0)
        yield a.f == resolve2(a.R, force_0)
        yield a.t == resolve2(a.R, cross(b.r_0 - a.r_0, force_0))

    def supplied_power(self):
        """Power of the force at both frames."""
        a, b = self.frame_a, self.frame_b
        return -(dot(a.f, a.v) + dot(a.t, a.R.w) + dot(b.f, b.v))

    def shapes(self):
        """The force, and what it is in frame_a."""
        yield from (force_arrow(self.frame_b), force_arrow(self.frame_a), torque_arrow(self.frame_a))
