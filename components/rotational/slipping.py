"""Slipping: base of contacts that stick or slide."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, der, discrete, piecewise, quantity, reinit, sign, when
from components.rotational.compliant import Compliant


class Slipping(Compliant):
    """Base of dry friction: sticks up to one torque, slides against another.

    While it sticks, tau is what keeps w_rel constant; it breaks away where that exceeds `holding()`. So nothing determines
    tau where both ends have a given motion that comes to rest, as between a `Speed` and a wall, or at a joint that the rest of
    a machine carries through a dead centre.
    """

    mode: Scalar = discrete("1 slides forward, 0 sticks, -1 slides backward", unit="1", start=sign(Compliant.w_rel))
    w_stuck: Scalar = discrete("w_rel when it last broke away, 0 but for rounding", unit="rad/s")

    def law(self) -> Any:
        """Relative acceleration 0 or torque of sliding."""
        stuck = (self.mode > -0.5) & (self.mode < 0.5)
        inertia = quantity(1.0, "kg.m2")  # both cases are torques
        yield piecewise((inertia * der(self.w_rel), stuck), self.tau - self.mode * self.dragging()) == 0
        for sense in (1, -1):
            slides, torque = sense * self.mode > 0.5, sense * self.tau
            breaks = (reinit(self.mode, sense), reinit(self.w_stuck, self.w_rel))
            yield when(stuck & (torque > self.holding()), *breaks, at_start=True)
            yield when(slides & (sense * (self.w_rel - self.w_stuck) < 0), reinit(self.mode, 0))

    def holding(self) -> Expr:
        """Greatest torque at which it sticks."""
        raise NotImplementedError("returns the greatest torque at which it sticks", "return ...")

    def dragging(self) -> Expr:
        """Torque against sliding."""
        raise NotImplementedError("returns the torque against sliding", "return ...")

    def dissipated_power(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w_rel
