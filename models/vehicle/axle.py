"""Axle of a car: two corners and the mounting of their tie rods."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, chain, connect, parameter, part, port, structural
from components import FixedTranslation, Frame
from models.vehicle.corner import Corner
from models.vehicle.points import offset

TIE = (-0.12, 0.25, 0.38)


class Axle(Component):
    """Two corners; frame_a is fixed to the chassis, frame_tie to the part that holds the tie rods, chassis or rack."""

    height: Any = structural("height of the ground, as for Tyre", default=None, choices=(None, callable))
    v: Scalar = parameter("initial speed", unit="m/s", default=0)
    preload: Scalar = parameter("initial force of the struts", unit="N", default=3.6e3)
    frame_a, frame_tie = port(Frame, "fixed to the chassis"), port(Frame, "mounting of the tie rods")
    tie_right, tie_left = (FixedTranslation(r=offset((0, 0, 0), TIE, side)) for side in (1, -1))
    right, left = (part(lambda s, side=side: s.corner(side)) for side in (1, -1))

    def corner(self, side: int) -> Corner:
        """Corner on one side."""
        return Corner(side=side, height=self.height, v=self.v, preload=self.preload)

    def connections(self):
        for corner, tie in ((self.right, self.tie_right), (self.left, self.tie_left)):
            yield connect(self.frame_a, corner.frame_a)
            yield chain(self.frame_tie, tie, corner.frame_tie)
