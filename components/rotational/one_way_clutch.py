"""OneWayClutch: freewheel in parallel with a clutch."""

from __future__ import annotations

from acausal import Expr, Scalar, discrete, piecewise, quantity, reinit, require, sign, when
from components.rotational.compliant import Compliant
from components.rotational.pressed_shaft import PressedShaft

# Smallest breakaway torque over tau_max: round-off of a zero torque must not separate the shafts of an open clutch (value of
# the Modelica library).
LEAST = 1e-4
# Negative initial w_rel in rad/s that counts as 0: round-off of the start values.
ROUNDING = 1e-9


class OneWayClutch(PressedShaft, Compliant):
    """Freewheel and clutch in parallel: flange_b may overrun flange_a, w_rel >= 0, against the friction of the clutch.

    Notes
    -----
    At equal speeds it transmits any driving torque of flange_a, tau < 0, and the clutch torque in the opposite direction.
    """

    mode: Scalar = discrete("1 flange_b overrunning, 0 locked", unit="1", start=sign(Compliant.w_rel))
    w_stuck: Scalar = discrete("w_rel at the last transition, 0 up to rounding", unit="rad/s")

    def law(self):
        """Zero relative acceleration or sliding torque."""
        sticks = self.mode < 0.5
        yield piecewise((quantity(1.0, "kg.m2") * self.a_rel, sticks), self.tau - self.dragging()) == 0
        overruns = reinit(self.mode, 1), reinit(self.w_stuck, self.w_rel)
        yield when(sticks & (self.tau > self.holding()), *overruns, at_start=True)
        yield when((self.mode > 0.5) & (self.w_rel < self.w_stuck), reinit(self.mode, 0))

    def requirements(self):
        yield from super().requirements()
        yield require(
            self.w_rel > quantity(-ROUNDING, "rad/s"),
            f"{self._path or type(self).__name__} starts with w_rel < 0, which a freewheel does not allow: start flange_b at "
            "least as fast as flange_a, or exchange the flanges",
        )

    def holding(self) -> Expr:
        """Breakaway torque."""
        closed, least = super().holding(), LEAST * self.tau_max
        return piecewise((closed, closed > least), least)

    def sliding_speed(self) -> Expr:
        """Relative speed."""
        return self.w_rel

    def loss(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w_rel
