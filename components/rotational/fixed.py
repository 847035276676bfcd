"""Fixed: fixed shaft end."""

from __future__ import annotations

from acausal import Component, Scalar, parameter, port
from components.flange import Flange


class Fixed(Component):
    """Shaft end fixed at a constant angle."""

    ends = ("flange", "flange")
    phi0: Scalar = parameter("angle of the flange", unit="rad", default=0)
    flange: Flange = port(Flange, "fixed shaft end")

    def equations(self):
        yield self.flange.phi == self.phi0
