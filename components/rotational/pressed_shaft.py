"""PressedShaft: base of clutches and brakes of shafts."""

from __future__ import annotations

from acausal import Scalar, parameter, require
from components.pressed_friction import PressedFriction

# Share of tau_max that rounding of its products makes.
ROUNDING = 1e-12


class PressedShaft(PressedFriction):
    """Base of clutches and brakes of shafts; a subclass says what slides."""

    speed_unit = "rad/s"
    cgeo: Scalar = parameter(
        "torque over the friction force",
        unit="m",
        default=1,
        minimum=0,
        doc="Number of friction faces times their mean radius.",
    )
    fn_max: Scalar = parameter(
        "greatest normal force",
        unit="N",
        default=lambda s: s.tau_max / (s.mu_0() * s.cgeo),
        minimum=0,
        doc="That of tau_max if not given.",
    )
    tau_max: Scalar = parameter(
        "torque of sliding at the speed 0 and f_normalized = 1",
        unit="N.m",
        default=lambda s: s.mu_0() * s.cgeo * s.fn_max,
        minimum=0,
        doc="mu_pos cgeo fn_max if not given. One of fn_max and tau_max is needed.",
    )

    def requirements(self):
        yield from super().requirements()
        text = f"`tau_max` of {self._path or type(self).__name__} is not mu_pos cgeo fn_max. Give one of tau_max and fn_max"
        product = self.mu_0() * self.cgeo * self.fn_max
        yield require(abs(self.tau_max - product) <= ROUNDING * product, text)
