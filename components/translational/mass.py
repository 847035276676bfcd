"""Mass: sliding mass."""

from __future__ import annotations

from acausal import PREFER, Scalar, der, parameter, variable
from components.translational.rigid import Rigid


class Mass(Rigid):
    """Sliding mass with two rod ends."""

    m: Scalar = parameter("mass", unit="kg", minimum=0)
    v: Scalar = variable("der(s)", unit="m/s", select=PREFER)
    a: Scalar = variable("der(v)", unit="m/s2")

    def equations(self):
        yield from super().equations()
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange_a.f + self.flange_b.f

    def stored_energy(self):
        """Kinetic energy."""
        return self.m * self.v**2 / 2
