"""Circuits of Modelica.Electrical.Analog.Examples."""

from __future__ import annotations

import numpy as np

from acausal import Model, connect, fixed, guess
from components import electrical as el
from tests.reference.msl.published import compare

ANALOG = "Modelica.Electrical.Analog.Examples."


def joined(*pins):
    return [connect(pins[0], pin) for pin in pins[1:]]


class Cauer(Model):
    ground, V = el.Ground(), el.StepVoltage(V=1, start_time=1)
    C1, C3, C5 = el.Capacitor(C=1.072), el.Capacitor(C=1.682), el.Capacitor(C=0.7262)
    C2 = el.Capacitor(C=1 / (1.704992**2 * 1.304), v=guess(0))
    C4 = el.Capacitor(C=1 / (1.179945**2 * 0.8586), v=guess(0))
    L1, L2 = el.Inductor(L=1.304), el.Inductor(L=0.8586)
    R1, R2 = el.Resistor(R=1), el.Resistor(R=1)

    def connections(self):
        yield from joined(self.V.p, self.R1.p)
        yield from joined(self.R1.n, self.C1.p, self.L1.p, self.C2.p)
        yield from joined(self.L1.n, self.C2.n, self.C3.p, self.L2.p, self.C4.p)
        yield from joined(self.L2.n, self.C4.n, self.C5.p, self.R2.p)
        yield from joined(self.V.n, self.ground.p, self.C1.n, self.C3.n, self.C5.n, self.R2.n)


def test_cauer_low_pass():
    compare(ANALOG + "CauerLowPassAnalog", Cauer())


class Rectifier(Model):
    s1 = el.SineVoltage(V=400 * np.sqrt(2 / 3), f=50)
    s2 = el.SineVoltage(V=400 * np.sqrt(2 / 3), f=50, phase=-2 / 3 * np.pi)
    s3 = el.SineVoltage(V=400 * np.sqrt(2 / 3), f=50, phase=-4 / 3 * np.pi)
    Inductor1, Inductor2, Inductor3 = el.Inductor(L=60e-6, i=guess(0)), el.Inductor(L=60e-6), el.Inductor(L=60e-6)
    d1, d2, d3, d4, d5, d6 = (el.IdealDiode(Ron=1e-3, Goff=1e-3, Vknee=2) for _ in range(6))
    Capacitor1, Capacitor2 = (el.Capacitor(C=30e-3, v=fixed(200 * np.sqrt(2))) for _ in range(2))
    ground, load = el.Ground(), el.ConstantCurrent(I=500)

    def connections(self):
        yield from joined(self.s1.n, self.s2.n, self.s3.n)
        for s, coil, upper, lower in (
            (self.s1, self.Inductor1, self.d1, self.d4),
            (self.s2, self.Inductor2, self.d2, self.d5),
            (self.s3, self.Inductor3, self.d3, self.d6),
        ):
            yield from joined(s.p, coil.p)
            yield from joined(coil.n, upper.p, lower.n)
        yield from joined(self.d1.n, self.d2.n, self.d3.n, self.Capacitor1.p, self.load.p)
        yield from joined(self.d4.p, self.d5.p, self.d6.p, self.Capacitor2.n, self.load.n)
        yield from joined(self.Capacitor1.n, self.Capacitor2.p, self.ground.p)


def test_rectifier():
    compare(ANALOG + "Rectifier", Rectifier(), tolerance=2e-3)


class Diodes(Model):
    ground = el.Ground()
    Ideal = el.IdealDiode(Ron=0, Goff=0)
    With_Ron_Goff = el.IdealDiode(Ron=0.1, Goff=0.1)
    With_Ron_Goff_Vknee = el.IdealDiode(Ron=0.2, Goff=0.2, Vknee=5)
    s1, s2, s3 = el.SineVoltage(V=10, offset=-9, f=1), el.SineVoltage(V=10, f=1), el.SineVoltage(V=10, f=1)
    R1, R2, R3 = (el.Resistor(R=1e-3) for _ in range(3))

    def connections(self):
        for s, diode, r in (
            (self.s2, self.Ideal, self.R1),
            (self.s1, self.With_Ron_Goff, self.R2),
            (self.s3, self.With_Ron_Goff_Vknee, self.R3),
        ):
            yield from joined(s.p, diode.p)
            yield from joined(diode.n, r.p)
            yield from joined(s.n, r.n, self.ground.p)


def test_characteristics_of_diodes():
    compare(ANALOG + "CharacteristicIdealDiodes", Diodes())
