"""Corner of a car: suspension and wheel."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, chain, connect, parameter, part, port, structural
from components import Flange, Frame
from models.vehicle.double_wishbone import DoubleWishbone
from models.vehicle.wheel import Wheel


class Corner(Component):
    """Suspension with a wheel."""

    ends = ("frame_a", "axis")
    side: int = structural("1 on the right, -1 on the left", default=1, choices=(1, -1))
    height: Any = structural("height of the ground, as for Tyre", default=None, choices=(None, callable))
    v: Scalar = parameter("initial speed", unit="m/s", default=0)
    preload: Scalar = parameter("initial force of the strut", unit="N", default=3.6e3)
    frame_a, frame_tie = port(Frame, "fixed to the chassis"), port(Frame, "inner end of the tie rod")
    axis: Flange = port(Flange, "drive shaft of the wheel")

    @part
    def suspension(self):
        """Suspension, replaceable."""
        return DoubleWishbone(side=self.side, preload=self.preload)

    @part
    def wheel(self):
        """Wheel, replaceable."""
        return Wheel(height=self.height, v=self.v)

    def connections(self):
        yield chain(self.frame_a, self.suspension, self.wheel, self.axis)
        yield connect(self.frame_tie, self.suspension.frame_tie)
