"""IdealOpAmp: ideal operational amplifier."""

from __future__ import annotations

from components.electrical.two_port import TwoPort


class IdealOpAmp(TwoPort):
    """Ideal operational amplifier: no voltage and no current at the first port."""

    def equations(self):
        yield from super().equations()
        yield self.v1 == 0
        yield self.i1 == 0

    def supplied_power(self):
        """Power of the output."""
        return -self.v2 * self.i2
