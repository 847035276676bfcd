"""VoltageSensor: measures the voltage between two pins."""

from __future__ import annotations

from acausal import Component, Scalar, output, port
from components.electrical.pin import Pin


class VoltageSensor(Component):
    """Measures the voltage between two pins."""

    p: Pin = port(Pin, "positive pin")
    n: Pin = port(Pin, "negative pin")
    v: Scalar = output("voltage p.v - n.v", unit="V")

    def equations(self):
        yield self.v == self.p.v - self.n.v
        yield self.p.i == 0
        yield self.n.i == 0
