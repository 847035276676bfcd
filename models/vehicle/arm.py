"""Suspension arm."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, chain, fixed, parameter, part, structural
from components import BodyShape, FixedTranslation, Revolute, TwoFrames
from models.vehicle.points import diagonal


class Arm(TwoFrames):
    """Suspension arm on a bearing along x; frame_a is fixed to the chassis, frame_b to the arm at its ball joint."""

    at: Any = structural("bearing, resolved in frame_a, in m", shape=(3,))
    r: Any = structural("from the bearing to the ball joint, in m", shape=(3,))
    m: Scalar = parameter("mass", unit="kg", default=5)
    starts: bool = structural("whether the arm is fixed at rest initially", default=False, choices=(True, False))

    @part
    def mount(self):
        """Offset from frame_a to the bearing."""
        return FixedTranslation(r=self.at)

    @part
    def bearing(self):
        """Bearing at the chassis."""
        return Revolute(n=(1, 0, 0), **({"phi": fixed(0), "w": fixed(0)} if self.starts else {}))

    @part
    def body(self):
        """The arm: inertia of a rod, with half the transverse moment of inertia about z."""
        J = self.m * (self.r[1] ** 2 + self.r[2] ** 2) / 12
        return BodyShape(r=self.r, r_CM=self.r / 2, m=self.m, I=diagonal(J, J, J / 2))

    def connections(self):
        yield chain(self.frame_a, self.mount, self.bearing, self.body, self.frame_b)
