"""Compliant: base of forces between two rod ends."""

from __future__ import annotations

from typing import Any

from acausal import Scalar, der, variable
from components.translational.flange import TwoFlanges


class Compliant(TwoFlanges):
    """Base of forces that depend on the relative position; a subclass defines f."""

    s_rel: Scalar = variable("position of flange_b relative to flange_a", unit="m")
    v_rel: Scalar = variable("der(s_rel)", unit="m/s")
    f: Scalar = variable("force between the flanges, flange_b.f", unit="N")

    def equations(self):
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.v_rel == der(self.s_rel)
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f
        yield from self.law()

    def law(self) -> Any:
        """Yield the equation of f."""
        raise NotImplementedError("yields the equation of the force f", "yield self.f == ...")
