"""PressedFriction: base of friction that a normal force makes."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import Expr, Scalar, input, parameter, piecewise, structural, variable
from components.speed_table import SpeedTable
from components.thermal.heat_loss import HeatLoss


class PressedFriction(HeatLoss):
    """Base of brakes and clutches, whose friction is mu cgeo fn; a subclass declares cgeo and says what slides."""

    speed_unit: ClassVar[str]
    mu_pos: Any = structural(
        "coefficient of friction over the sliding speed",
        default=((0, 0.5),),
        doc="A number, or rows (speed, coefficient) of ascending speeds from 0 on, between which it is linear.",
    )
    peak: Scalar = parameter(
        "ratio of the greatest load of sticking and that of sliding", unit="1", default=1, minimum=1
    )
    cgeo: Any
    sliding_speed: ClassVar[Any]  # method: sliding speed, not less than 0 while it slides
    fn_max: Scalar = parameter("greatest normal force", unit="N", minimum=0)
    f_normalized: Scalar = input(
        "normal force as a fraction of its greatest value",
        unit="1",
        doc="Between 0 (open) and 1 (closed); negative is open.",
    )
    fn: Scalar = variable("normal force", unit="N")

    def equations(self):
        yield from super().equations()
        yield self.fn == piecewise((self.fn_max * self.f_normalized, self.f_normalized > 0), 0)

    def holding(self) -> Expr:
        """Greatest load of sticking."""
        return self.peak * self.mu_0() * self.cgeo * self.fn

    def dragging(self) -> Expr:
        """Load of sliding."""
        return self._mu().at(self.sliding_speed()) * self.cgeo * self.fn

    def mu_0(self) -> Expr:
        """Coefficient of friction at the speed 0."""
        return self._mu().at_rest()

    def _mu(self) -> SpeedTable:
        return SpeedTable(self, "mu_pos", self.speed_unit, "1")
