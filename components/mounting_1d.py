"""Mounting1D: housing of a drive train on a moving body."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, parameter, port, structural
from components.flange import Flange
from components.frame import Frame
from components.orientation import unit_vector
from components.world import require_direction


class Mounting1D(Component):
    """Fixes a shaft end to frame_a and transmits its torque about n to frame_a."""

    ends = ("frame_a", "flange_b")
    phi0: Scalar = parameter("angle of flange_b relative to frame_a", unit="rad", default=0)
    n: Any = structural(
        "axis of the torque, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    frame_a: Frame = port(Frame, "mounting of the housing")
    flange_b: Flange = port(Flange, "fixed shaft end")

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def equations(self):
        yield self.flange_b.phi == self.phi0
        yield self.frame_a.f == (0, 0, 0)
        yield self.frame_a.t == -unit_vector(self.n) * self.flange_b.tau
