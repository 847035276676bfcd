"""Disc: rigid massless shaft."""

from __future__ import annotations

from acausal import Scalar, parameter, variable
from components.flange import TwoFlanges


class Disc(TwoFlanges):
    """Rigid massless shaft with a constant angle between its flanges."""

    delta_phi: Scalar = parameter("angle of flange_b relative to flange_a", unit="rad", default=0)
    phi: Scalar = variable("mean angle of the flanges", unit="rad")

    def equations(self):
        yield self.flange_a.phi == self.phi - self.delta_phi / 2
        yield self.flange_b.phi == self.phi + self.delta_phi / 2
        yield self.flange_a.tau + self.flange_b.tau == 0
