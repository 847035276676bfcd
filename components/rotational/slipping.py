"""Slipping: base of dry friction between two shaft ends."""

from __future__ import annotations

from acausal import Expr, Scalar, discrete, quantity, sign
from components.dry_friction import DryFriction
from components.rotational.compliant import Compliant


class Slipping(DryFriction, Compliant):
    """Base of dry friction between two shaft ends."""

    mode: Scalar = discrete("1 slides forward, 0 sticks, -1 slides backward", unit="1", start=sign(Compliant.w_rel))
    w_stuck: Scalar = discrete("w_rel when it last stuck or broke away, 0 but for rounding", unit="rad/s")
    w_slip: Scalar = discrete("change of w_rel at which it no longer rests where others keep it at rest", unit="rad/s")

    def law(self):
        """Dry friction against w_rel."""
        yield from self.stick_slip(self.w_rel, self.tau, quantity(1.0, "kg.m2"), self.w_stuck, self.w_slip)

    def loss(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w_rel

    def sliding_speed(self) -> Expr:
        """Relative speed, not less than 0 while it slides."""
        return self.mode * self.w_rel
