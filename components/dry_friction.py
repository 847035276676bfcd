"""DryFriction: base of contacts that stick or slide."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from acausal import Expr, Scalar, der, discrete, piecewise, reinit, set_valued, when
from components.thermal.heat_loss import HeatLoss

# Descriptions of the discrete variables that a subclass declares with its own units.
MODE = "1 sliding forward, 0 sticking, -1 sliding backward"
STUCK = "sliding speed at the last transition, 0 up to rounding"
SLIP = "change of the sliding speed that ends a redundant rest"


class DryFriction(HeatLoss):
    """Base of dry friction: sticks up to the load `holding()`, slides against the load `dragging()`.

    During sticking the load keeps the sliding speed constant. Sliding starts when that load exceeds `holding()`. If the load
    has no effect on the acceleration, as in a joint that the mechanism drives through rest, the sliding direction reverses
    without sticking. If other parts already hold the contact at rest (redundant rest), the load is a share of `holding()`.
    """

    mode: Scalar = discrete(MODE, unit="1")
    shared: Scalar = discrete("1 at a redundant rest", unit="1")
    share: Scalar = discrete("load over holding() at a redundant rest", unit="1")

    def stick_slip(self, speed: Expr, load: Expr, inertia: Expr, stuck: Expr, slip: Expr) -> Iterator[Any]:
        """Yield the friction law, der(speed) = 0 or the sliding load, and the transitions between both.

        Parameters
        ----------
        speed, load : Expr
            Sliding speed and the load against it; their product is the lost power.
        inertia : Expr
            Unit inertia, which gives both cases the unit of a load.
        stuck, slip : Expr
            Discrete variables: the speed at the last transition, 0 up to rounding, and the change of the speed that ends a
            redundant rest.
        """
        rests = (self.mode > -0.5) & (self.mode < 0.5)
        sticks, shares = rests & (self.shared < 0.5), rests & (self.shared > 0.5)
        applied = self.mode * self.dragging() + self.share * self.holding()
        yield piecewise((inertia * der(speed), sticks), load - applied) == 0
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
        """Largest load of sticking."""
        raise NotImplementedError("returns the largest load of sticking", "return ...")

    def dragging(self) -> Expr:
        """Load of sliding."""
        raise NotImplementedError("returns the load of sliding", "return ...")
