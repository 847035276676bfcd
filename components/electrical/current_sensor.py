"""CurrentSensor: measures the current in a line."""

from __future__ import annotations

from acausal import Component, Scalar, output, port
from components.electrical.pin import Pin


class CurrentSensor(Component):
    """Measures the current in a line."""

    ends = ("p", "n")
    p: Pin = port(Pin, "positive pin")
    n: Pin = port(Pin, "negative pin")
    i: Scalar = output("current from p to n", unit="A")

    def equations(self):
        yield self.p.v == self.n.v
        yield self.p.i == self.i
        yield self.n.i == -self.i
