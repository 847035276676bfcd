"""PowerSensor: power in a line."""

from __future__ import annotations

from acausal import Component, Scalar, output, port
from components.electrical.pin import Pin


class PowerSensor(Component):
    """Measures the power in a line: voltage of pv against nv, times the current from pc to nc."""

    ends = ("pc", "nc")
    pc: Pin = port(Pin, "positive pin of the current path")
    nc: Pin = port(Pin, "negative pin of the current path")
    pv: Pin = port(Pin, "positive pin of the voltage path")
    nv: Pin = port(Pin, "negative pin of the voltage path")
    power: Scalar = output("power", unit="W")

    def equations(self):
        yield self.pc.v == self.nc.v
        yield self.pc.i == -self.nc.i
        yield self.pv.i == 0
        yield self.nv.i == 0
        yield self.power == self.pc.i * (self.pv.v - self.nv.v)
