"""Slipping: base of dry friction between two shaft ends."""

from __future__ import annotations

from acausal import Expr, Scalar, discrete, quantity, sign
from components.dry_friction import MODE, SLIP, STUCK, DryFriction
from components.rotational.compliant import Compliant


class Slipping(DryFriction, Compliant):
    """Base of dry friction between two shaft ends."""

    mode: Scalar = discrete(MODE, unit="1", start=sign(Compliant.w_rel))
    w_stuck: Scalar = discrete(STUCK, unit="rad/s")
    w_slip: Scalar = discrete(SLIP, unit="rad/s")

    def law(self):
        """Dry friction opposing w_rel."""
        yield from self.stick_slip(self.w_rel, self.tau, quantity(1.0, "kg.m2"), self.w_stuck, self.w_slip)

    def loss(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w_rel

    def sliding_speed(self) -> Expr:
        """Magnitude of the relative speed during sliding."""
        return self.mode * self.w_rel
