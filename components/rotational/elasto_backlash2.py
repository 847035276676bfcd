"""ElastoBacklash2: a torsional spring and damper with backlash, whose torque jumps at contact."""

from __future__ import annotations

from acausal import Expr, piecewise
from components.rotational.elasto_backlash import ElastoBacklash


class ElastoBacklash2(ElastoBacklash):
    """Torsional spring and damper that act beyond the backlash; where the damper acts in full the torque jumps at contact."""

    def push(self, depth: Expr, rate: Expr) -> Expr:
        """Torque at a depth > 0 beyond the backlash, unless it would pull."""
        torque = self.c * depth + self.d * rate
        return piecewise((torque, torque > 0), 0)
