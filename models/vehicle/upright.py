"""Suspension upright."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, connect, parameter, part, port, structural
from components import Body, FixedTranslation, Frame
from models.vehicle.points import diagonal


class Upright(Component):
    """Upright with frames at the lower and upper ball joints, the tie rod and the wheel."""

    ends = ("lower", "hub")
    m: Scalar = parameter("mass", unit="kg", default=15)
    r_upper: Any = structural("from the lower ball joint to the upper one, in m", shape=(3,))
    r_tie: Any = structural("from the lower ball joint to the tie rod, in m", shape=(3,))
    r_hub: Any = structural("from the lower ball joint to the centre of the wheel, in m", shape=(3,))
    lower, upper = port(Frame, "at the lower ball joint"), port(Frame, "at the upper ball joint")
    tie, hub = port(Frame, "at the tie rod"), port(Frame, "at the centre of the wheel")
    to_upper = part(lambda s: FixedTranslation(r=s.r_upper))
    to_tie = part(lambda s: FixedTranslation(r=s.r_tie))
    to_hub = part(lambda s: FixedTranslation(r=s.r_hub))

    @part
    def body(self):
        """Mass, at the midpoint of the ball joints."""
        return Body(m=self.m, r_CM=self.r_upper / 2, I=diagonal(0.2, 0.1, 0.2))

    def connections(self):
        yield connect(self.lower, self.body.frame_a)
        for way, end in ((self.to_upper, self.upper), (self.to_tie, self.tie), (self.to_hub, self.hub)):
            yield connect(self.lower, way.frame_a)
            yield connect(way.frame_b, end)
