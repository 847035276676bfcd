"""SlidingTorque: base of friction with a given torque."""

from __future__ import annotations

from typing import Any, ClassVar

from acausal import DeclarationError, Expr, Scalar, parameter, require, structural
from components.speed_table import SpeedTable
from components.thermal.heat_loss import HeatLoss


class SlidingTorque(HeatLoss):
    """Base of friction whose torque is given, as a constant or over the speed; a subclass says what slides."""

    sliding_speed: ClassVar[Any]  # method: sliding speed, not less than 0 while it slides
    tau_pos: Any = structural(
        "torque against sliding over the speed",
        default=None,
        doc="A number in N.m, or rows (speed in rad/s, torque in N.m) of ascending speeds from 0 on, between which it is linear; "
        "tau_sliding if not given.",
    )
    tau_sliding: Scalar = parameter(
        "torque against sliding at the speed 0",
        unit="N.m",
        minimum=0,
        default=lambda s: s.first_torque(),
        doc="That of tau_pos if not given.",
    )
    peak: Scalar = parameter(
        "ratio of the greatest torques of sticking and of sliding at the speed 0", unit="1", default=1, minimum=1
    )
    tau_static: Scalar = parameter(
        "greatest torque of sticking",
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
            f"`tau_sliding` of {name} is more than its `tau_static`: it would stick and slide again without end. Give a larger "
            "`tau_static`",
        )
        if self.tau_pos is not None:
            contradicts = f"`tau_sliding` of {name} is not what its `tau_pos` says at the speed 0. Give one of them"
            yield require(self.tau_sliding - self.first_torque(), lambda gap: contradicts if gap else "")

    def first_torque(self) -> Expr:
        """Torque of tau_pos at the speed 0."""
        if self.tau_pos is None:
            name = self._path or type(self).__name__
            raise DeclarationError(
                f"{name} has no torque: give `tau_sliding`, or `tau_pos`, its torque over the speed."
            )
        return self._tau().at_rest()

    def holding(self) -> Expr:
        """Torque of stiction."""
        return self.tau_static

    def dragging(self) -> Expr:
        """Torque of sliding."""
        if self.tau_pos is None:
            return self.tau_sliding
        return self._tau().at(self.sliding_speed())

    def _tau(self) -> SpeedTable:
        return SpeedTable(self, "tau_pos", "rad/s", "N.m")
