"""SlidingTorque: base of dry friction with a specified torque."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import DeclarationError, Expr, Scalar, parameter, require, structural
from components.speed_table import SpeedTable
from components.thermal.heat_loss import HeatLoss


class SlidingTorque(HeatLoss):
    """Base of dry friction with a constant or speed-dependent torque; a subclass defines the sliding speed."""

    sliding_speed: ClassVar[Any]  # method: magnitude of the speed during sliding
    tau_pos: Any = structural(
        "sliding torque over the speed",
        default=None,
        doc="A number in N.m, or rows (speed in rad/s, torque in N.m) with ascending speeds from 0 on, linearly interpolated; "
        "tau_sliding if not given.",
    )
    tau_sliding: Scalar = parameter(
        "sliding torque at zero speed",
        unit="N.m",
        minimum=0,
        default=lambda s: s.first_torque(),
        doc="Value of tau_pos if not given.",
    )
    peak: Scalar = parameter(
        "ratio of the largest sticking torque to the sliding torque at zero speed", unit="1", default=1, minimum=1
    )
    tau_static: Scalar = parameter(
        "largest sticking torque",
        unit="N.m",
        minimum=0,
        default=lambda s: s.peak * s.tau_sliding,
        doc="peak tau_sliding if not given.",
    )

    def requirements(self):
        yield from super().requirements()
        name = self._path or type(self).__name__
        yield require(
            self.tau_sliding <= self.tau_static,
            f"`tau_sliding` of {name} exceeds `tau_static`: sticking and sliding would alternate endlessly. Give a larger "
            "`tau_static`",
        )
        if self.tau_pos is not None:
            contradicts = f"`tau_sliding` of {name} differs from its `tau_pos` at zero speed; give one of them"
            yield require(self.tau_sliding - self.first_torque(), lambda gap: contradicts if gap else "")

    def first_torque(self) -> Expr:
        """Torque of tau_pos at zero speed."""
        if self.tau_pos is None:
            name = self._path or type(self).__name__
            raise DeclarationError(
                f"{name} has no friction torque; give `tau_sliding`, or `tau_pos`, the torque over the speed."
            )
        return self._tau().at_rest()

    def holding(self) -> Expr:
        """Largest torque of sticking."""
        return self.tau_static

    def dragging(self) -> Expr:
        """Torque of sliding."""
        if self.tau_pos is None:
            return self.tau_sliding
        return self._tau().at(self.sliding_speed())

    def _tau(self) -> SpeedTable:
        return SpeedTable(self, "tau_pos", "rad/s", "N.m")
