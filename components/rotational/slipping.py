"""Slipping: base of contacts that stick or slide."""

from __future__ import annotations

from typing import Any

from acausal import Expr, Scalar, der, discrete, piecewise, quantity, reinit, set_valued, sign, when
from components.rotational.compliant import Compliant


class Slipping(Compliant):
    """Base of dry friction: sticks up to one torque, slides against another.

    While it sticks, tau is what keeps w_rel constant; it breaks away where that exceeds `holding()`. Where tau does not change
    the acceleration, as at a joint that the rest of a machine carries through rest, it slides on the other way. Where others
    keep it at rest already, its torque is a share of `holding()`.
    """

    mode: Scalar = discrete("1 slides forward, 0 sticks, -1 slides backward", unit="1", start=sign(Compliant.w_rel))
    w_stuck: Scalar = discrete("w_rel when it last stuck or broke away, 0 but for rounding", unit="rad/s")
    shared: Scalar = discrete("1 where others keep it at rest", unit="1")
    share: Scalar = discrete("torque over holding() where others keep it at rest", unit="1")
    w_slip: Scalar = discrete("change of w_rel at which it no longer rests then", unit="rad/s")

    def law(self) -> Any:
        """Relative acceleration 0 or torque of sliding."""
        rests = (self.mode > -0.5) & (self.mode < 0.5)
        sticks, shares = rests & (self.shared < 0.5), rests & (self.shared > 0.5)
        inertia = quantity(1.0, "kg.m2")  # both cases are torques
        given = self.mode * self.dragging() + self.share * self.holding()
        yield piecewise((inertia * der(self.w_rel), sticks), self.tau - given) == 0
        yield set_valued(
            self.w_rel,
            limit=self.holding(),
            mode=self.mode,
            offset=self.w_stuck,
            shared=self.shared,
            share=self.share,
            slip=self.w_slip,
        )
        for sense in (1, -1):
            moves = sense * (self.w_rel - self.w_stuck)
            slides = reinit(self.mode, sense), reinit(self.shared, 0), reinit(self.share, 0)
            here, stops = reinit(self.w_stuck, self.w_rel), (reinit(self.mode, 0), reinit(self.w_slip, 0))
            yield when(sticks & (sense * self.tau > self.holding()), *slides, here, at_start=True)
            yield when(shares & (moves > self.w_slip), *slides)
            yield when((sense * self.mode > 0.5) & (moves < 0), *stops)

    def holding(self) -> Expr:
        """Greatest torque at which it sticks."""
        raise NotImplementedError("returns the greatest torque at which it sticks", "return ...")

    def dragging(self) -> Expr:
        """Torque against sliding."""
        raise NotImplementedError("returns the torque against sliding", "return ...")

    def dissipated_power(self) -> Expr:
        """Power of the torque."""
        return self.tau * self.w_rel
