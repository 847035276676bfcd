"""IdealOpAmpLimited: ideal operational amplifier with limits."""

from __future__ import annotations

from acausal import Component, Scalar, piecewise, port, variable
from components.electrical.pin import Pin


class IdealOpAmpLimited(Component):
    """Ideal operational amplifier whose output lies between two potentials."""

    in_p: Pin = port(Pin, "positive pin of the input")
    in_n: Pin = port(Pin, "negative pin of the input")
    out: Pin = port(Pin, "output")

    VMax: Pin = port(Pin, "upper potential of the output")
    VMin: Pin = port(Pin, "lower potential of the output")
    v_in: Scalar = variable("voltage in_p.v - in_n.v", unit="V")
    s: Scalar = variable("-1 to 1 within the limits of the output, beyond by the voltage of the input in V")

    def equations(self):
        s, upper, lower = self.s, self.VMax.v, self.VMin.v
        yield self.in_p.i == 0
        yield self.in_n.i == 0
        yield self.VMax.i == 0
        yield self.VMin.i == 0
        yield self.v_in == self.in_p.v - self.in_n.v
        yield self.v_in == piecewise((s + 1, s < -1), (s - 1, s > 1), 0)
        yield self.out.v == piecewise((lower, s < -1), (upper, s > 1), (upper - lower) * s / 2 + (upper + lower) / 2)

    def supplied_power(self):
        """Power of the output."""
        return -self.out.v * self.out.i
