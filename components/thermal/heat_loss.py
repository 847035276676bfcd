"""HeatLoss: base of parts that dissipate power as heat."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, port, structural, variable
from components.thermal.heat_port import HeatPort


class HeatLoss(Component):
    """Base of parts whose losses may heat other parts; a subclass defines loss().

    Notes
    -----
    Without a heat port the loss is dissipated power; with a heat port it is a heat flow.
    """

    use_heat_port: bool = structural("whether losses flow out of heat_port", default=False, choices=(True, False))
    loss_power: Scalar = variable("power dissipated as heat", unit="W")

    @port
    def heat_port(self) -> HeatPort | None:
        """Outlet of the losses."""
        return HeatPort() if self.use_heat_port else None

    def equations(self):
        yield from super().equations()
        yield self.loss_power == self.loss()
        if self.use_heat_port:
            yield self.heat_port.Q_flow == -self.loss_power

    def dissipated_power(self):
        """Power of the loss without a heat port, else 0."""
        return 0.0 if self.use_heat_port else self.loss()

    def loss(self) -> Any:
        """Power dissipated as heat, in W."""
        raise NotImplementedError("returns the power dissipated as heat", "return ...")
