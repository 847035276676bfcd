"""Gearbox: gear with losses, elasticity and backlash."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, connect, der, parameter, part, port, structural, variable
from components.flange import Flange, TwoFlanges
from components.rotational.elasto_backlash import ElastoBacklash
from components.rotational.lossy_gear import LossyGear
from components.thermal.heat_port import HeatPort


class Gearbox(TwoFlanges):
    """Gear with losses, in series with elasticity, damping and backlash at flange_b."""

    use_support: bool = structural("whether the housing has a flange `support`", default=False, choices=(True, False))
    use_heat_port: bool = structural("whether losses flow out of heat_port", default=False, choices=(True, False))
    ratio: Scalar = parameter("transmission ratio, flange_a.phi / flange_b.phi without elasticity", unit="1")
    loss_table: Any = structural(
        "losses over the speed of flange_a", default=LossyGear.loss_table.default, doc="As for LossyGear."
    )
    c: Scalar = parameter("spring constant, at flange_b", unit="N.m/rad", minimum=0)
    d: Scalar = parameter("damping constant, at flange_b", unit="N.m.s/rad", default=0, minimum=0)
    b: Scalar = parameter("total backlash, at flange_b", unit="rad", default=0, minimum=0)
    phi_rel: Scalar = variable("angle of flange_b relative to the gear output", unit="rad")
    w_rel: Scalar = variable("der(phi_rel)", unit="rad/s")
    a_rel: Scalar = variable("der(w_rel)", unit="rad/s2")

    @port
    def support(self) -> Flange | None:
        """Housing."""
        return Flange() if self.use_support else None

    @port
    def heat_port(self) -> HeatPort | None:
        """Outlet of the losses."""
        return HeatPort() if self.use_heat_port else None

    @part
    def gear(self) -> Component:
        """Gear with losses."""
        return LossyGear(
            ratio=self.ratio, loss_table=self.loss_table, use_support=self.use_support, use_heat_port=self.use_heat_port
        )

    @part
    def elasticity(self) -> Component:
        """Elasticity, damping and backlash."""
        return ElastoBacklash(c=self.c, d=self.d, b=self.b, use_heat_port=self.use_heat_port)

    def connections(self):
        yield connect(self.flange_a, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.elasticity.flange_a)
        yield connect(self.elasticity.flange_b, self.flange_b)
        if self.use_support:
            yield connect(self.support, self.gear.support)
        if self.use_heat_port:
            yield connect(self.heat_port, self.gear.heat_port)
            yield connect(self.heat_port, self.elasticity.heat_port)

    def equations(self):
        yield self.phi_rel == self.flange_b.phi - self.gear.flange_b.phi
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
