"""SpringDamperSeries: a spring and a damper in series between two frames."""

from __future__ import annotations

from acausal import Scalar, der, geometry, parameter, variable
from components.line_force import LineForce
from components.thermal.heat_loss import HeatLoss


class SpringDamperSeries(HeatLoss, LineForce):
    """Linear damper from frame_a on, and linear spring from there to frame_b, along one line."""

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    d: Scalar = parameter("damping constant", unit="N.s/m", positive=True)
    s_unstretched: Scalar = parameter(
        "unstretched length of the spring", unit="m", default=0, minimum=0, doc="There it bears no force."
    )
    s_damper: Scalar = variable("length of the damper", unit="m", start=0, fixed=True)

    def law(self):
        """One force in the spring and in the damper."""
        yield self.f == self.c * (self.s - self.s_unstretched - self.s_damper)
        yield self.d * der(self.s_damper) == self.f

    def shapes(self):
        """A coil."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "coil")

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.s - self.s_unstretched - self.s_damper) ** 2 / 2

    def loss(self):
        """Power of the damper."""
        return self.f**2 / self.d
