"""OnePort: base of components with two pins."""

from __future__ import annotations

from acausal import Component, Scalar, port, variable
from components.electrical.pin import Pin


class OnePort(Component):
    """Base of components with two pins and one current."""

    ends = ("p", "n")
    p: Pin = port(Pin, "positive pin")
    n: Pin = port(Pin, "negative pin")
    v: Scalar = variable("voltage p.v - n.v", unit="V")
    i: Scalar = variable("current from p to n", unit="A")

    def equations(self):
        yield self.v == self.p.v - self.n.v
        yield self.p.i == self.i
        yield self.n.i == -self.i
