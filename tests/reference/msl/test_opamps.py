"""Circuits with operational amplifiers, and resonance circuits, of Modelica.Electrical.Analog.Examples."""

from __future__ import annotations

import numpy as np
import pytest

from acausal import (
    Component,
    Model,
    Scalar,
    clip,
    connect,
    cos,
    der,
    fixed,
    port,
    quantity,
    sin,
    time,
    trapezoid,
    variable,
)
from components import electrical as el
from tests.reference.msl.published import compare

ANALOG = "Modelica.Electrical.Analog.Examples."
F = 10
WAVE = {"rising": 0.2 / F, "width": 0.3 / F, "falling": 0.2 / F, "period": 1 / F, "start_time": -0.35 / F}
SQUARE, BOTH = trapezoid(amplitude=5, **WAVE), trapezoid(amplitude=10, offset=-5, **WAVE)


class OpAmp(Component):
    """Amplification of 15,000 within 15 V."""

    in_p: el.Pin = port(el.Pin, "positive input")
    in_n: el.Pin = port(el.Pin, "negative input")
    out: el.Pin = port(el.Pin, "output")
    v_in: Scalar = variable("voltage in_p.v - in_n.v", unit="V")

    def equations(self):
        yield self.in_p.i == 0
        yield self.in_n.i == 0
        yield self.v_in == self.in_p.v - self.in_n.v
        yield self.out.v == self.limited()

    def limited(self):
        """Potential of the output."""
        return clip(15000 * self.v_in, -15, 15)


class Amplifier(Model):
    """An amplifier with grounded positive input, a source, and impedances before it and around it."""

    opAmp, ground, source = OpAmp(), el.Ground(), el.SignalVoltage(v=SQUARE)
    before, around = (), ()

    def connections(self):
        yield connect(self.source.n, self.ground.p)
        yield connect(self.opAmp.in_p, self.ground.p)
        pin = self.source.p
        for name in self.before:
            yield connect(pin, getattr(self, name).p)
            pin = getattr(self, name).n
        yield connect(pin, self.opAmp.in_n)
        for name in self.around:
            yield connect(self.opAmp.out, getattr(self, name).p)
            yield connect(self.opAmp.in_n, getattr(self, name).n)


class LowPass(Amplifier):
    r1, r2, c = el.Resistor(R=1000), el.Resistor(R=1000), el.Capacitor(C=1e-3 / (2 * np.pi), v=fixed(0))
    before, around = ("r1",), ("r2", "c")


class HighPass(Amplifier):
    r1, r2, c = el.Resistor(R=1000), el.Resistor(R=1000), el.Capacitor(C=1e-3 / (2 * np.pi), v=fixed(0))
    before, around = ("c", "r1"), ("r2",)


class Integrator(Amplifier):
    source = el.SignalVoltage(v=BOTH)
    r, c = el.Resistor(R=1000), el.Capacitor(C=0.5 / (2 * np.pi * F * 1000), v=fixed(0))
    before, around = ("r",), ("c",)


class Differentiator(Amplifier):
    source = el.SignalVoltage(v=BOTH)
    r, c = el.Resistor(R=1000), el.Capacitor(C=2 / (2 * np.pi * F * 1000), v=fixed(0))
    before, around = ("c",), ("r",)


@pytest.mark.parametrize(
    ("model", "part"),
    [(LowPass, "firstOrder."), (HighPass, "derivative."), (Integrator, "integrator."), (Differentiator, "der_.")],
)
def test_filters(model, part):
    names = {f"{part}{own}": own for own in ("c.v", "opAmp.out.v", "opAmp.out.i")}
    compare(f"{ANALOG}OpAmps.{model.__name__}", model(), names)


class SchmittTrigger(Model):
    opAmp, ground, vIn = OpAmp(), el.Ground(), el.SignalVoltage(v=BOTH)
    r1, r2 = el.Resistor(R=1000), el.Resistor(R=15000)

    def connections(self):
        yield connect(self.vIn.n, self.ground.p)
        yield connect(self.opAmp.in_n, self.ground.p)
        yield connect(self.vIn.p, self.r1.p)
        yield connect(self.r1.n, self.opAmp.in_p)
        yield connect(self.r2.p, self.opAmp.in_p)
        yield connect(self.r2.n, self.opAmp.out)


def test_schmitt_trigger():
    compare(ANALOG + "OpAmps.SchmittTrigger", SchmittTrigger())


class Comparator(Model):
    opAmp, ground, vIn = OpAmp(), el.Ground(), el.SignalVoltage(v=BOTH)
    upper, lower = el.Resistor(R=500), el.Resistor(R=500)
    positive, negative = el.ConstantVoltage(V=15), el.ConstantVoltage(V=15)

    def connections(self):
        yield connect(self.vIn.n, self.ground.p)
        yield connect(self.vIn.p, self.opAmp.in_p)
        yield connect(self.positive.n, self.ground.p)
        yield connect(self.negative.p, self.ground.p)
        yield connect(self.positive.p, self.upper.p)
        yield connect(self.upper.n, self.opAmp.in_n)
        yield connect(self.lower.p, self.opAmp.in_n)
        yield connect(self.lower.n, self.negative.n)


def test_comparator():
    compare(ANALOG + "OpAmps.Comparator", Comparator())


class SeriesResonance(Model):
    """Two circuits, with a sine and a cosine of rising frequency."""

    ground = el.Ground()
    phi: Scalar = variable("phase", unit="rad", start=0, fixed=True)
    resistor1, resistor2 = el.Resistor(R=0.5), el.Resistor(R=0.5)
    inductor1, inductor2 = (el.Inductor(L=0.1 / (2 * np.pi)) for _ in range(2))
    capacitor1, capacitor2 = (el.Capacitor(C=0.001 / (2 * np.pi)) for _ in range(2))
    source1, source2 = el.SignalVoltage(), el.SignalVoltage()

    def connections(self):
        for k in "12":
            source, coil, c, r = (getattr(self, name + k) for name in ("source", "inductor", "capacitor", "resistor"))
            yield connect(source.p, coil.p)
            yield connect(coil.n, c.p)
            yield connect(c.n, r.p)
            yield connect(r.n, self.ground.p)
            yield connect(source.n, self.ground.p)

    def equations(self):
        yield der(self.phi) == 2 * np.pi * 200 * time
        yield self.source1.v == quantity(sin(self.phi), "V")
        yield self.source2.v == quantity(cos(self.phi), "V")


class ParallelResonance(SeriesResonance):
    source1, source2 = el.SignalCurrent(), el.SignalCurrent()

    def connections(self):
        for k in "12":
            source, coil, c, r = (getattr(self, name + k) for name in ("source", "inductor", "capacitor", "resistor"))
            yield connect(source.n, r.p)
            yield connect(r.n, coil.p)
            yield connect(source.n, c.p)
            for pin in (source.p, coil.n, c.n):
                yield connect(pin, self.ground.p)

    def equations(self):
        yield der(self.phi) == 2 * np.pi * 200 * time
        yield self.source1.i == quantity(sin(self.phi), "A")
        yield self.source2.i == quantity(cos(self.phi), "A")


@pytest.mark.parametrize(("model", "kind"), [(SeriesResonance, "Voltage"), (ParallelResonance, "Current")])
def test_resonance(model, kind):
    names = {f"{wave}{kind}.phi": "phi" for wave in ("sine", "cosine")}
    compare(ANALOG + model.__name__, model(), names)
