"""Axle of a car: two corners and what their tie rods hang on."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, chain, connect, parameter, part, port, structural
from components import FixedTranslation, Frame
from models.vehicle.corner import Corner
from models.vehicle.points import way

TIE = (-0.12, 0.25, 0.38)


class Axle(Component):
    """Two corners; frame_a is fixed to the chassis, frame_tie holds the tie rods: the chassis or a rack, at frame_a."""

    height: Any = structural("height of the ground at a place", default=None, choices=(None, callable))
    v: Scalar = parameter("speed at the start", unit="m/s", default=0)
    preload: Scalar = parameter("force of the struts at the start", unit="N", default=3.6e3)
    frame_a, frame_tie = port(Frame, "fixed to the chassis"), port(Frame, "holds the tie rods")
    tie_right, tie_left = (FixedTranslation(r=way((0, 0, 0), TIE, side)) for side in (1, -1))
    right, left = (part(lambda s, side=side: s.corner(side)) for side in (1, -1))

    def corner(self, side: int) -> Corner:
        """Corner on one side."""
        return Corner(side=side, height=self.height, v=self.v, preload=self.preload)

    def connections(self):
        for corner, tie in ((self.right, self.tie_right), (self.left, self.tie_left)):
            yield connect(self.frame_a, corner.frame_a)
            yield chain(self.frame_tie, tie, corner.frame_tie)
