"""PressedFriction: base of dry friction under a controlled normal force."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import Expr, Scalar, input, parameter, piecewise, structural, variable
from components.speed_table import SpeedTable
from components.thermal.heat_loss import HeatLoss


class PressedFriction(HeatLoss):
    """Base of brakes and clutches with friction mu cgeo fn; a subclass declares cgeo and the sliding speed."""

    speed_unit: ClassVar[str]
    mu_pos: Any = structural(
        "coefficient of friction over the sliding speed",
        default=((0, 0.5),),
        doc="A number, or rows (speed, coefficient) with ascending speeds from 0 on, linearly interpolated.",
    )
    peak: Scalar = parameter("ratio of the largest sticking load to the sliding load", unit="1", default=1, minimum=1)
    cgeo: Any
    sliding_speed: ClassVar[Any]  # method: magnitude of the speed during sliding
    fn_max: Scalar = parameter("maximum normal force", unit="N", minimum=0)
    f_normalized: Scalar = input(
        "normal force as a fraction of fn_max",
        unit="1",
        doc="Between 0 (open) and 1 (closed); negative values are open.",
    )
    fn: Scalar = variable("normal force", unit="N")

    def equations(self):
        yield from super().equations()
        yield self.fn == piecewise((self.fn_max * self.f_normalized, self.f_normalized > 0), 0)

    def holding(self) -> Expr:
        """Largest load of sticking."""
        return self.peak * self.mu_0() * self.cgeo * self.fn

    def dragging(self) -> Expr:
        """Load of sliding."""
        return self._mu().at(self.sliding_speed()) * self.cgeo * self.fn

    def mu_0(self) -> Expr:
        """Coefficient of friction at zero speed."""
        return self._mu().at_rest()

    def _mu(self) -> SpeedTable:
        return SpeedTable(self, "mu_pos", self.speed_unit, "1")
