"""MassWithStopAndFriction: sliding mass with Stribeck friction between hard stops."""

from __future__ import annotations

from acausal import (
    Expr,
    Scalar,
    der,
    discrete,
    exp,
    parameter,
    piecewise,
    quantity,
    reinit,
    require,
    sign,
    variable,
    when,
)
from components.thermal.heat_loss import HeatLoss
from components.translational.rigid import Rigid

# Largest sticking force over the sliding force at zero speed: above 1 against chattering (value of the Modelica library).
PEAK = 1.001


class MassWithStopAndFriction(HeatLoss, Rigid):
    """Sliding mass with viscous, Coulomb and Stribeck friction between two inelastic stops.

    Notes
    -----
    The sliding friction is F_prop v + sign(v) (F_Coulomb + F_Stribeck exp(-fexp |v|)). At a stop the mass loses its kinetic
    energy and rests until a force pulls it away.
    """

    m: Scalar = parameter("mass", unit="kg", minimum=0)
    F_prop: Scalar = parameter("viscous friction", unit="N.s/m", minimum=0)
    F_Coulomb: Scalar = parameter("Coulomb friction", unit="N", minimum=0)
    F_Stribeck: Scalar = parameter("Stribeck friction at zero speed", unit="N", minimum=0)
    fexp: Scalar = parameter("decay of the Stribeck friction over the speed", unit="s/m", minimum=0)
    smax: Scalar = parameter("stop of flange_b", unit="m", default=25)
    smin: Scalar = parameter("stop of flange_a", unit="m", default=-25)
    v: Scalar = variable("der(s)", unit="m/s")
    a: Scalar = variable("der(v)", unit="m/s2")
    f: Scalar = variable("force of friction and stops against the motion", unit="N")
    mode: Scalar = discrete("1 sliding forward, 0 at rest, -1 sliding backward", unit="1", start=sign(v))
    stopped: Scalar = discrete("1 at smax, -1 at smin, else 0", unit="1")
    v_stuck: Scalar = discrete("v at the last transition, 0 up to rounding", unit="m/s")

    def equations(self):
        yield from super().equations()
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange_a.f + self.flange_b.f - self.f
        rests = (self.mode > -0.5) & (self.mode < 0.5)
        yield piecewise((quantity(1.0, "kg") * self.a, rests), self.f - self._sliding()) == 0
        most = PEAK * (self.F_Coulomb + self.F_Stribeck)
        for sense in (1, -1):
            leaves = rests & (sense * self.f > most) & (sense * self.stopped < 0.5)
            slides = reinit(self.mode, sense), reinit(self.v_stuck, self.v), reinit(self.stopped, 0)
            yield when(leaves, *slides, at_start=True)
            turns = (sense * self.mode > 0.5) & (sense * (self.v - self.v_stuck) < 0)
            yield when(turns, reinit(self.mode, 0))
            stop = (self.smax if sense == 1 else self.smin) - sense * self.L / 2
            still = reinit(self.s, stop), reinit(self.v, 0), reinit(self.v_stuck, 0)
            yield when(
                sense * (self.s - stop) >= 0, *still, reinit(self.mode, 0), reinit(self.stopped, sense), at_start=True
            )

    def requirements(self):
        name = self._path or type(self).__name__
        yield require(self.smax - self.smin > self.L, f"the stops of {name} are closer than its length L")
        for sense, stop, word in ((1, self.smax, "smax"), (-1, self.smin, "smin")):
            yield require(
                sense * (stop - self.s) >= self.L / 2,
                f"{name} starts beyond its stop {word}; start it between its stops",
            )

    def stored_energy(self):
        """Kinetic energy."""
        return self.m * self.v**2 / 2

    def loss(self) -> Expr:
        """Power of the friction."""
        return self.f * self.v

    def _sliding(self) -> Expr:
        stribeck = self.F_Stribeck * exp(-self.fexp * self.mode * self.v)
        return self.F_prop * self.v + self.mode * (self.F_Coulomb + stribeck)
