"""Mounting1D: the housing of a drive train on a moving body."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, parameter, port, structural
from components.flange import Flange
from components.frame import Frame
from components.orientation import unit_vector
from components.world import require_direction


class Mounting1D(Component):
    """Holds a shaft end in frame_a, and passes its torque about n on to it."""

    ends = ("frame_a", "flange_b")
    phi0: Scalar = parameter("angle of flange_b relative to frame_a", unit="rad", default=0)
    n: Any = structural(
        "axis of the torque, resolved in frame_a", default=(1, 0, 0), shape=(3,), doc="Any nonzero length."
    )
    frame_a: Frame = port(Frame, "where the housing is fixed")
    flange_b: Flange = port(Flange, "the held shaft end")

    def check(self) -> None:
        """Reject an axis of length 0."""
        require_direction(self, self.n, "n")

    def equations(self):
        yield self.flange_b.phi == self.phi0
        yield self.frame_a.f == (0, 0, 0)
        yield self.frame_a.t == -unit_vector(self.n) * self.flange_b.tau
