"""IdealGear: gear without inertia or losses."""

from __future__ import annotations

from acausal import Scalar, parameter
from components.rotational.two_flanges_and_support import TwoFlangesAndSupport


class IdealGear(TwoFlangesAndSupport):
    """Gear without inertia, elasticity, backlash or losses."""

    ratio: Scalar = parameter("transmission ratio, phi_a / phi_b", unit="1")

    def equations(self):
        yield from super().equations()
        yield self.phi_a == self.ratio * self.phi_b
        yield self.ratio * self.flange_a.tau + self.flange_b.tau == 0
