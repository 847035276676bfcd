"""Clutch: couples two shafts by friction."""

from __future__ import annotations

from acausal import Expr, Scalar, input, parameter
from components.rotational.slipping import Slipping


class Clutch(Slipping):
    """Friction clutch: slips until both shafts turn alike, then locks up to its greatest torque."""

    f_normalized: Scalar = input(
        "normal force as a fraction of its greatest value", unit="1", doc="Between 0 (open) and 1 (closed)."
    )
    tau_max: Scalar = parameter("torque of sliding at f_normalized = 1", unit="N.m", minimum=0)
    peak: Scalar = parameter("ratio of the greatest torques of sticking and sliding", unit="1", default=1, minimum=1)

    def holding(self) -> Expr:
        """Greatest torque of sticking."""
        return self.peak * self.dragging()

    def dragging(self) -> Expr:
        """Torque of sliding."""
        return self.tau_max * self.f_normalized
