"""Spring: linear spring."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.translational.compliant import Compliant


class Spring(Compliant):
    """Linear spring."""

    c: Scalar = parameter("spring constant", unit="N/m", minimum=0)
    s_rel0: Scalar = parameter("unstretched length", unit="m", default=0, doc="The force is 0 there.")

    def law(self):
        """Hooke's law."""
        yield self.f == self.c * (self.s_rel - self.s_rel0)

    def stored_energy(self):
        """Elastic energy."""
        return self.c * (self.s_rel - self.s_rel0) ** 2 / 2
