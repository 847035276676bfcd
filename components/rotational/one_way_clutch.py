"""OneWayClutch: a freewheel beside a clutch."""

from __future__ import annotations

from acausal import Expr, Scalar, discrete, piecewise, quantity, reinit, require, sign, when
from components.rotational.compliant import Compliant
from components.rotational.pressed_shaft import PressedShaft

# Share of tau_max below which the open clutch does not let go, so that rounding of a torque of 0 does not part the shafts (as
# in Modelica).
LEAST = 1e-4
# Speed in rad/s that rounding of start values makes.
ROUNDING = 1e-9


class OneWayClutch(PressedShaft, Compliant):
    """Freewheel and clutch side by side: flange_b may overrun flange_a, w_rel >= 0, against the friction of the clutch.

    Notes
    -----
    While the shafts turn alike it takes any torque that flange_a drives with, tau < 0, and the torque of the clutch against it.
    """

    mode: Scalar = discrete("1 flange_b overrunning, 0 locked", unit="1", start=sign(Compliant.w_rel))
    w_stuck: Scalar = discrete("w_rel at the last transition, 0 up to rounding", unit="rad/s")

    def law(self):
        """Relative acceleration 0 or torque of sliding."""
        sticks = self.mode < 0.5
        yield piecewise((quantity(1.0, "kg.m2") * self.a_rel, sticks), self.tau - self.dragging()) == 0
        overruns = reinit(self.mode, 1), reinit(self.w_stuck, self.w_rel)
        yield when(sticks & (self.tau > self.holding()), *overruns, at_start=True)
        yield when((self.mode > 0.5) & (self.w_rel < self.w_stuck), reinit(self.mode, 0))

    def requirements(self):
        yield from super().requirements()
        yield require(
            self.w_rel > quantity(-ROUNDING, "rad/s"),
            f"{self._path or type(self).__name__} starts with w_rel < 0, which a freewheel does not allow: let flange_b turn at "
            "least as fast as flange_a, or connect it the other way round",
        )

    def holding(self) -> Expr:
        """Torque at which the shafts part."""
        closed, least = super().holding(), LEAST * self.tau_max
        return piecewise((closed, closed > least), least)

    def sliding_speed(self) -> Expr:
        """Relative speed."""
        return self.w_rel

    def loss(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w_rel
