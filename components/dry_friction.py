"""DryFriction: base of contacts that stick or slide."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import Expr, Scalar, der, discrete, piecewise, reinit, set_valued, when
from components.thermal.heat_loss import HeatLoss


class DryFriction(HeatLoss):
    """Base of dry friction: sticks up to one load, slides against another.

    While it sticks, the load is what keeps the sliding speed constant; it breaks away where that exceeds `holding()`. Where the
    load does not change the acceleration, as at a joint that the rest of a machine carries through rest, it slides on the other
    way. Where others keep it at rest already, its load is a share of `holding()`.
    """

    mode: Scalar = discrete("1 slides forward, 0 sticks, -1 slides backward", unit="1")
    shared: Scalar = discrete("1 where others keep it at rest", unit="1")
    share: Scalar = discrete("load over holding() where others keep it at rest", unit="1")

    def stick_slip(self, speed: Expr, load: Expr, inertia: Expr, stuck: Expr, slip: Expr) -> Iterator[Any]:
        """Acceleration 0 or load of sliding, and when one becomes the other.

        Parameters
        ----------
        speed, load : Expr
            Sliding speed, and what resists it; their product is the power of the loss.
        inertia : Expr
            One of its unit, so that both cases are loads.
        stuck, slip : Expr
            Discrete variables: the speed when it last stuck or broke away, 0 but for rounding, and the change of the speed at
            which it no longer rests where others keep it at rest.
        """
        rests = (self.mode > -0.5) & (self.mode < 0.5)
        sticks, shares = rests & (self.shared < 0.5), rests & (self.shared > 0.5)
        given = self.mode * self.dragging() + self.share * self.holding()
        yield piecewise((inertia * der(speed), sticks), load - given) == 0
        yield set_valued(
            speed, limit=self.holding(), mode=self.mode, offset=stuck, shared=self.shared, share=self.share, slip=slip
        )
        for sense in (1, -1):
            moves = sense * (speed - stuck)
            slides = reinit(self.mode, sense), reinit(self.shared, 0), reinit(self.share, 0)
            here, stops = reinit(stuck, speed), (reinit(self.mode, 0), reinit(slip, 0))
            yield when(sticks & (sense * load > self.holding()), *slides, here, at_start=True)
            yield when(shares & (moves > slip), *slides)
            yield when((sense * self.mode > 0.5) & (moves < 0), *stops)

    def holding(self) -> Expr:
        """Greatest load at which it sticks."""
        raise NotImplementedError("returns the greatest load at which it sticks", "return ...")

    def dragging(self) -> Expr:
        """Load against sliding."""
        raise NotImplementedError("returns the load against sliding", "return ...")
