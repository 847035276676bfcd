"""BallJoint: holds two points together that move on their own."""

from __future__ import annotations

from components import TwoFrames, resolve1, resolve2


class BallJoint(TwoFrames):
    """Ball joint that closes a loop: three equations, and no coordinates of its own."""

    def equations(self):
        a, b = self.frame_a, self.frame_b
        yield a.r_0 == b.r_0
        yield a.f == -resolve2(a.R, resolve1(b.R, b.f))
        yield a.t == (0, 0, 0)
        yield b.t == (0, 0, 0)
