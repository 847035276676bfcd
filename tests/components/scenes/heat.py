"""Parts of heat: a damper at the joint warms them."""

from __future__ import annotations

from acausal import chain, connect, fixed, sin, time
from components import thermal
from components import translational as t
from tests.components.scenes.rods import WithMass


class Warm(WithMass):
    """The damper heats a capacitor, which gives its heat to the surroundings through `it`."""

    damper = t.Damper(d=3.0, use_heat_port=True)
    capacitor = thermal.HeatCapacitor(C=0.5, T=fixed(300.0))
    outside = thermal.FixedTemperature(T=293.15)

    def drive(self):
        yield chain(self.slide.axis, self.damper, self.mass)
        yield connect(self.damper.heat_port, self.capacitor.port)
        yield from self.heat()

    def heat(self):
        yield chain(self.capacitor.port, self.it, self.outside.port)


class OnConductor(Warm):
    it = thermal.ThermalConductor(G=0.4)


class OnConvection(Warm):
    it = thermal.Convection(Gc=0.4)


class OnCapacitor(Warm):
    capacitor = None
    outside = None
    it = thermal.HeatCapacitor(C=0.5, T=fixed(300.0))

    def drive(self):
        yield chain(self.slide.axis, self.damper, self.mass)
        yield connect(self.damper.heat_port, self.it.port)


class OnFixedTemperature(OnCapacitor):
    it = thermal.FixedTemperature(T=293.15)


class OnPrescribedTemperature(OnCapacitor):
    it = thermal.PrescribedTemperature(T=293.15 + 10 * sin(3 * time))
