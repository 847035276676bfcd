"""PressedShaft: base of clutches and brakes of shafts."""

from __future__ import annotations

from acausal import Scalar, parameter, require
from components.pressed_friction import PressedFriction

# Relative difference of tau_max and mu_pos cgeo fn_max that counts as 0: round-off of the product.
ROUNDING = 1e-12


class PressedShaft(PressedFriction):
    """Base of clutches and brakes of shafts; a subclass defines the sliding speed."""

    speed_unit = "rad/s"
    cgeo: Scalar = parameter(
        "friction torque over friction force",
        unit="m",
        default=1,
        minimum=0,
        doc="Number of friction faces times the mean radius.",
    )
    fn_max: Scalar = parameter(
        "maximum normal force",
        unit="N",
        default=lambda s: s.tau_max / (s.mu_0() * s.cgeo),
        minimum=0,
        doc="tau_max / (mu_pos cgeo) if not given.",
    )
    tau_max: Scalar = parameter(
        "sliding torque at zero speed and f_normalized = 1",
        unit="N.m",
        default=lambda s: s.mu_0() * s.cgeo * s.fn_max,
        minimum=0,
        doc="mu_pos cgeo fn_max if not given. Specify fn_max or tau_max.",
    )

    def requirements(self):
        yield from super().requirements()
        text = f"`tau_max` of {self._path or type(self).__name__} is not mu_pos cgeo fn_max; give only one of tau_max and fn_max"
        product = self.mu_0() * self.cgeo * self.fn_max
        yield require(abs(self.tau_max - product) <= ROUNDING * product, text)
