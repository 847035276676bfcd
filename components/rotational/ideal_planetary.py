"""IdealPlanetary: planetary gear without inertia or losses."""

from __future__ import annotations

from acausal import Component, Scalar, parameter, port
from components.flange import Flange


class IdealPlanetary(Component):
    """Planetary gear without inertia, elasticity, backlash or losses."""

    ends = ("sun", "ring")
    ratio: Scalar = parameter("number of teeth of the ring over that of the sun", unit="1")
    sun: Flange = port(Flange, "shaft of the sun")
    carrier: Flange = port(Flange, "shaft of the carrier")
    ring: Flange = port(Flange, "shaft of the ring")

    def equations(self):
        yield (1 + self.ratio) * self.carrier.phi == self.sun.phi + self.ratio * self.ring.phi
        yield self.ring.tau == self.ratio * self.sun.tau
        yield self.carrier.tau == -(1 + self.ratio) * self.sun.tau
