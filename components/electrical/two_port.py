"""TwoPort: base of components with two ports."""

from __future__ import annotations

from acausal import Component, Scalar, port, variable
from components.electrical.pin import Pin


class TwoPort(Component):
    """Base of components with two pairs of pins."""

    p1: Pin = port(Pin, "positive pin of the first port")
    n1: Pin = port(Pin, "negative pin of the first port")
    p2: Pin = port(Pin, "positive pin of the second port")
    n2: Pin = port(Pin, "negative pin of the second port")
    v1: Scalar = variable("voltage p1.v - n1.v", unit="V")
    v2: Scalar = variable("voltage p2.v - n2.v", unit="V")
    i1: Scalar = variable("current from p1 to n1", unit="A")
    i2: Scalar = variable("current from p2 to n2", unit="A")

    def equations(self):
        yield self.v1 == self.p1.v - self.n1.v
        yield self.v2 == self.p2.v - self.n2.v
        yield self.p1.i == self.i1
        yield self.n1.i == -self.i1
        yield self.p2.i == self.i2
        yield self.n2.i == -self.i2
