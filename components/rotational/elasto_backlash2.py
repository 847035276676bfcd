"""ElastoBacklash2: torsional spring and damper with backlash and a torque that jumps at contact."""

from __future__ import annotations

from acausal import Expr, piecewise
from components.rotational.elasto_backlash import ElastoBacklash


class ElastoBacklash2(ElastoBacklash):
    """Torsional spring and unlimited damper in series with a backlash; the torque jumps at contact."""

    def contact_torque(self, depth: Expr, rate: Expr) -> Expr:
        """Contact torque at the depth > 0 beyond the backlash, not adhesive."""
        torque = self.c * depth + self.d * rate
        return piecewise((torque, torque > 0), 0)
