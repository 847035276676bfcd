"""SignalCurrent: source of a current that is a signal."""

from __future__ import annotations

from acausal import Component, Scalar, input, port, variable
from components.electrical.pin import Pin


class SignalCurrent(Component):
    """Source of a current that is a signal."""

    ends = ("p", "n")
    p: Pin = port(Pin, "positive pin")
    n: Pin = port(Pin, "negative pin")
    v: Scalar = variable("voltage p.v - n.v", unit="V")
    i: Scalar = input("current from p to n", unit="A")

    def equations(self):
        yield self.v == self.p.v - self.n.v
        yield self.p.i == self.i
        yield self.n.i == -self.i

    def supplied_power(self):
        """Power into the circuit."""
        return -self.v * self.i
