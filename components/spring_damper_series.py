"""SpringDamperSeries: spring and damper in series between two frames."""

from __future__ import annotations

from acausal import Scalar, der, geometry, parameter, variable
from components.line_force import LineForce
from components.thermal.heat_loss import HeatLoss


class SpringDamperSeries(HeatLoss, LineForce):
    """Linear damper at frame_a and linear spring at frame_b in series, along the line from frame_a to frame_b."""

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.s/m", positive=True)
    s_unstretched: Scalar = parameter(
        "unstretched length of the spring", unit="m", default=0, minimum=0, doc="The force is 0 there."
    )
    s_damper: Scalar = variable("length of the damper", unit="m", start=0, fixed=True)

    def law(self):
        """Equal force in spring and damper."""
        yield self.f == self.c * (self.s - self.s_unstretched - self.s_damper)
        yield self.d * der(self.s_damper) == self.f

    def shapes(self):
        """A damper and a coil, each half of the line."""
        middle = (self.frame_a.r_0 + self.frame_b.r_0) / 2
        yield geometry.Span(self.frame_a.r_0, middle, "damper")
        yield geometry.Span(middle, self.frame_b.r_0, "coil")

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.s - self.s_unstretched - self.s_damper) ** 2 / 2

    def loss(self):
        """Power of the damper."""
        return self.f**2 / self.d
