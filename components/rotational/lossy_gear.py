"""LossyGear: gear with mesh and bearing losses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from acausal import (
    DeclarationError,
    Expr,
    Scalar,
    der,
    discrete,
    parameter,
    piecewise,
    quantity,
    reinit,
    sign,
    structural,
    variable,
    when,
)
from components.rotational.two_flanges_and_support import TwoFlangesAndSupport
from components.speed_table import SpeedTable
from components.thermal.heat_loss import HeatLoss

# Speed in rad/s that counts as 0: round-off while adjacent bearings hold the gear must not trigger a stop.
ROUNDING = 1e-12


class LossyGear(HeatLoss, TwoFlangesAndSupport):
    """Massless gear with mesh efficiency and bearing friction, including stiction.

    Notes
    -----
    With the torque tau_a of flange_a, the lost torque of forward rotation is ::

        tau_loss = max((1 - eta_mf1) tau_a + tau_bf1, (1 - 1 / eta_mf2) tau_a + tau_bf2),

    for flange_a and flange_b driving (Pelchen, Schweiger and Otter 2002, Modeling and Simulating the Efficiency of Gearboxes
    and of Planetary Gearboxes). For backward rotation it is the minimum of both, with bearing friction of opposite sign.
    Between these two values the gear sticks. A prescribed motion must not pass through rest: insert an elastic shaft.
    """

    ratio: Scalar = parameter("transmission ratio, phi_a / phi_b", unit="1")
    loss_table: Any = structural(
        "losses over the speed of flange_a",
        default=((0, 1, 1, 0, 0),),
        doc="Rows (speed in rad/s, eta_mf1, eta_mf2, tau_bf1, tau_bf2) with ascending speeds from 0 on: mesh efficiency and "
        "bearing friction in N.m, referred to flange_a, for flange_a driving (1) and flange_b driving (2).",
    )
    w_a: Scalar = variable("der(phi_a)", unit="rad/s")
    a_a: Scalar = variable("der(w_a)", unit="rad/s2")
    tau_loss: Scalar = variable("lost torque, referred to flange_a", unit="N.m")
    mode: Scalar = discrete("1 turning forward, 0 sticking, -1 turning backward", unit="1", start=sign(w_a))
    w_stuck: Scalar = discrete("w_a at the last transition, 0 up to rounding", unit="rad/s")

    def check(self) -> None:
        """Reject efficiencies outside 0 to 1, and negative bearing friction."""
        super().check()
        rows = self._table().rows
        if np.any(rows[:, 1:3] <= 0) or np.any(rows[:, 1:3] > 1) or np.any(rows[:, 3:] < 0):
            raise DeclarationError(
                f"`loss_table` of {self._path or type(self).__name__} has an efficiency that is not above 0 and at most 1, or "
                "negative bearing friction; its rows are (speed, eta_mf1, eta_mf2, tau_bf1, tau_bf2)."
            )

    def equations(self):
        yield from super().equations()
        yield self.phi_a == self.ratio * self.phi_b
        yield self.ratio * (self.flange_a.tau - self.tau_loss) + self.flange_b.tau == 0
        yield self.w_a == der(self.phi_a)
        yield self.a_a == der(self.w_a)
        if np.all(self._table().rows[:, 1:] == (1, 1, 0, 0)):
            yield self.tau_loss == 0
        else:
            yield from self._stick_slip()

    def loss(self) -> Expr:
        """Power of the loss."""
        return self.tau_loss * self.w_a

    def _stick_slip(self) -> Iterator[Any]:
        """Yield the law, zero acceleration or mesh and bearing losses, and the transitions between both."""
        table, speed = self._table(), self.mode * self.w_a
        first, now = ([at(k) for k in range(1, 5)] for at in (table.at_rest, lambda k: table.at(speed, k)))
        rests = (self.mode > -0.5) & (self.mode < 0.5)
        turning = piecewise((self._lost_torque(1, *now), self.mode > 0.5), self._lost_torque(-1, *now))
        yield piecewise((quantity(1.0, "kg.m2") * self.a_a, rests), self.tau_loss - turning) == 0
        for sense in (1, -1):
            starts = rests & (sense * (self.tau_loss - self._lost_torque(sense, *first)) > 0)
            yield when(starts, reinit(self.mode, sense), reinit(self.w_stuck, self.w_a), at_start=True)
            stops = (sense * self.mode > 0.5) & (sense * (self.w_a - self.w_stuck) < -quantity(ROUNDING, "rad/s"))
            yield when(stops, reinit(self.mode, 0))

    def _lost_torque(self, sense: int, eta_mf1: Expr, eta_mf2: Expr, tau_bf1: Expr, tau_bf2: Expr) -> Expr:
        """Lost torque of rotation in the direction `sense`, 1 or -1."""
        a_drives = (1 - eta_mf1) * self.flange_a.tau + sense * tau_bf1
        b_drives = (1 - 1 / eta_mf2) * self.flange_a.tau + sense * tau_bf2
        return piecewise((a_drives, sense * (a_drives - b_drives) > 0), b_drives)

    def _table(self) -> SpeedTable:
        return SpeedTable(self, "loss_table", "rad/s", "1", "1", "N.m", "N.m")
