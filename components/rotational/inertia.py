"""Inertia: rigid rotor."""

from __future__ import annotations

from acausal import PREFER, Scalar, der, parameter, variable
from components.flange import TwoFlanges


class Inertia(TwoFlanges):
    """Rigid rotor with two shaft ends."""

    J: Scalar = parameter("moment of inertia", unit="kg.m2", minimum=0)
    phi: Scalar = variable("absolute angle", unit="rad", select=PREFER)
    w: Scalar = variable("der(phi)", unit="rad/s", select=PREFER)
    a: Scalar = variable("der(w)", unit="rad/s2")

    def equations(self):
        yield self.flange_a.phi == self.phi
        yield self.flange_b.phi == self.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a == self.flange_a.tau + self.flange_b.tau

    def stored_energy(self):
        """Kinetic energy."""
        return self.J * self.w**2 / 2
