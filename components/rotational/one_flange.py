"""OneFlange: base of supports and drives."""

from __future__ import annotations

from acausal import Component, Scalar, der, port, variable
from components.flange import Flange


class OneFlange(Component):
    """Base of drives with one shaft end, whose housing stands still."""

    ends = ("flange", "flange")
    flange: Flange = port(Flange, "shaft end")
    w: Scalar = variable("der(flange.phi)", unit="rad/s")

    def equations(self):
        yield self.w == der(self.flange.phi)

    def supplied_power(self):
        """Power into the shaft."""
        return -self.flange.tau * self.w
