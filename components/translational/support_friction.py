"""SupportFriction: Coulomb friction with stiction of a rod in its support."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, parameter, structural
from components.speed_table import SpeedTable
from components.translational.rod_friction import RodFriction


class SupportFriction(RodFriction):
    """Coulomb friction with stiction of a rigid massless rod in its support."""

    f_pos: Any = structural(
        "sliding force over the speed",
        default=((0, 1),),
        doc="A number in N, or rows (speed in m/s, force in N) with ascending speeds from 0 on, linearly interpolated.",
    )
    peak: Scalar = parameter(
        "ratio of the largest sticking force to the sliding force at zero speed", unit="1", default=1, minimum=1
    )

    def holding(self) -> Expr:
        """Largest force of sticking."""
        return self.peak * self._force().at_rest()

    def dragging(self) -> Expr:
        """Force of sliding."""
        return self._force().at(self.sliding_speed())

    def _force(self) -> SpeedTable:
        return SpeedTable(self, "f_pos", "m/s", "N")
