"""HeatLoss: base of parts that turn power into heat."""

from __future__ import annotations

from typing import Any

from acausal import Component, Scalar, port, structural, variable
from components.thermal.heat_port import HeatPort


class HeatLoss(Component):
    """Base of parts whose losses may heat other parts; a subclass states its loss().

    Notes
    -----
    Without a heat port the loss counts as dissipated; with one it flows on as heat.
    """

    use_heat_port: bool = structural("whether losses flow out of heat_port", default=False, choices=(True, False))
    loss_power: Scalar = variable("power that turns into heat", unit="W")

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
        """Power of the loss, where no heat port takes it."""
        return 0.0 if self.use_heat_port else self.loss()

    def loss(self) -> Any:
        """Power that turns into heat, in W."""
        raise NotImplementedError("returns the power that turns into heat", "return ...")
