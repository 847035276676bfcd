"""IdealOpAmp3Pin: ideal operational amplifier with three pins."""

from __future__ import annotations

from acausal import Component, port
from components.electrical.pin import Pin


class IdealOpAmp3Pin(Component):
    """Ideal operational amplifier with three pins, its output against ground."""

    in_p: Pin = port(Pin, "positive pin of the input")
    in_n: Pin = port(Pin, "negative pin of the input")
    out: Pin = port(Pin, "output")

    def equations(self):
        yield self.in_p.v == self.in_n.v
        yield self.in_p.i == 0
        yield self.in_n.i == 0

    def supplied_power(self):
        """Power of the output."""
        return -self.out.v * self.out.i
