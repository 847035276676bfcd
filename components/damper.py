"""Damper: linear damper between two frames."""

from __future__ import annotations

from acausal import Scalar, geometry, parameter
from components.line_force import LineForce
from components.thermal.heat_loss import HeatLoss


class Damper(HeatLoss, LineForce):
    """Linear damper along the line from frame_a to frame_b."""

    d: Scalar = parameter("damping constant", unit="N.s/m", minimum=0)

    def law(self):
        """Force proportional to the speed."""
        yield self.f == self.d * self.v

    def shapes(self):
        """A cylinder with a piston rod."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "damper")

    def loss(self):
        """Power of the force."""
        return self.d * self.v**2
