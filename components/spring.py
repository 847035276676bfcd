"""Spring: linear spring between two frames."""

from __future__ import annotations

from acausal import Scalar, geometry, parameter
from components.mass_on_line import MassOnLine


class Spring(MassOnLine):
    """Linear spring along the line from frame_a to frame_b, with an optional point mass m on the line."""

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    s_unstretched: Scalar = parameter("unstretched length", unit="m", default=0, minimum=0, doc="The force is 0 there.")

    def law(self):
        """Hooke's law."""
        yield self.f == self.c * (self.s - self.s_unstretched)

    def shapes(self):
        """A coil."""
        yield geometry.Span(self.frame_a.r_0, self.frame_b.r_0, "coil")

    def stored_energy(self):
        """Elastic energy, and the energy of the mass."""
        return super().stored_energy() + self.c * (self.s - self.s_unstretched) ** 2 / 2
