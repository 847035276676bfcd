"""SpringDamperParallel: spring and damper in parallel between two frames."""

from __future__ import annotations

from acausal import Scalar, geometry, parameter
from components.line_force import LineForce
from components.thermal.heat_loss import HeatLoss


class SpringDamperParallel(HeatLoss, LineForce):
    """Linear spring and damper in parallel along the line from frame_a to frame_b."""

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.s/m", default=0, minimum=0)
    s_unstretched: Scalar = parameter(
        "unstretched length", unit="m", default=0, minimum=0, doc="The spring force is 0 there."
    )

    def law(self):
        """Hooke's law, and a force proportional to the speed."""
        yield self.f == self.c * (self.s - self.s_unstretched) + self.d * self.v

    def shapes(self):
        """A coil about a damper."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "damper")
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "coil")

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.s - self.s_unstretched) ** 2 / 2

    def loss(self):
        """Power of the damper."""
        return self.d * self.v**2
