"""Force2: force between two rod ends."""

from __future__ import annotations

from acausal import Scalar, der, input
from components.translational.flange import TwoFlanges


class Force2(TwoFlanges):
    """Force on the rod at flange_b; the opposite force acts at flange_a."""

    f: Scalar = input("force on the rod at flange_b", unit="N")

    def equations(self):
        yield self.flange_a.f == self.f
        yield self.flange_b.f == -self.f

    def supplied_power(self):
        """Power of the force."""
        return self.f * der(self.flange_b.s - self.flange_a.s)
