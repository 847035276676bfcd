"""PotentialSensor: measures the potential of a pin."""

from __future__ import annotations

from acausal import Component, Scalar, output, port
from components.electrical.pin import Pin


class PotentialSensor(Component):
    """Measures the potential of a pin."""

    p: Pin = port(Pin, "pin")
    phi: Scalar = output("potential", unit="V")

    def equations(self):
        yield self.phi == self.p.v
        yield self.p.i == 0
