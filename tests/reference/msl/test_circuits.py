"""Circuits of Modelica.Electrical.Analog.Examples."""

from __future__ import annotations

import numpy as np

from acausal import Component, Model, connect, fixed, guess, port, structural
from components import blocks
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


c1, c2, c3, c4, c5 = 1.072, 1 / (1.704992**2 * 1.304), 1.682, 1 / (1.179945**2 * 0.8586), 0.7262


class CauerOPV(Model):
    ground, V = el.Ground(), el.StepVoltage(V=1, start_time=1)
    C1, C2, C3, C4, C7 = (el.Capacitor(C=c) for c in (c1 + c2, c2, 1.304, c4, 0.8586))
    C5, C6, C8, C9 = (el.Capacitor(C=c, v=guess(0)) for c in (c2, c2 + c3 + c4, c4, c4 + c5))
    Op1, Op2, Op3, Op4, Op5 = (el.IdealOpAmp3Pin() for _ in range(5))
    R1, R2, R3, R6, R7, R10, R11 = (el.Resistor(R=1) for _ in range(7))
    R4, R5, R8, R9 = (el.Resistor(R=-1) for _ in range(4))

    def connections(self):
        yield from joined(self.ground.p, self.V.p, *(getattr(self, f"Op{k}").in_p for k in range(1, 6)))
        yield from joined(self.V.n, self.R1.p)
        yield from joined(self.Op1.in_n, self.R1.n, self.C2.n, self.R2.n, self.C1.p, self.R3.p)
        yield from joined(self.Op1.out, self.C1.n, self.R3.n, self.R4.p, self.C5.p)
        yield from joined(self.Op2.in_n, self.R4.n, self.R5.n, self.C3.p)
        yield from joined(self.Op2.out, self.C3.n, self.R2.p, self.R7.p)
        yield from joined(self.Op3.in_n, self.R7.n, self.C5.n, self.R6.n, self.C6.p, self.C4.n)
        yield from joined(self.Op3.out, self.C6.n, self.R9.p, self.R5.p, self.C2.p, self.C8.p)
        yield from joined(self.Op4.in_n, self.R8.n, self.R9.n, self.C7.p)
        yield from joined(self.Op4.out, self.C7.n, self.R6.p, self.R10.p)
        yield from joined(self.Op5.in_n, self.R11.p, self.C9.p, self.R10.n, self.C8.n)
        yield from joined(self.Op5.out, self.C4.p, self.R8.p, self.R11.n, self.C9.n)


class SwitchedCapacitor(Component):
    """Resistance of 1 Ohm or -1 Ohm, of a capacitor that is charged and discharged in turn."""

    negative: bool = structural("whether the resistance is negative", default=False)
    p: el.Pin = port(el.Pin, "positive pin")
    n: el.Pin = port(el.Pin, "negative pin")
    pulse, ground, capacitor = blocks.BooleanPulse(period=0.1), el.Ground(), el.Capacitor(C=0.1)
    p1, n1 = el.IdealOpeningSwitch(), el.IdealOpeningSwitch()
    p2, n2 = el.IdealClosingSwitch(), el.IdealClosingSwitch()

    def connections(self):
        for switch in (self.p1, self.p2, self.n1, self.n2):
            yield connect(self.pulse.y, switch.control)
        to_pin, to_ground = (self.p2, self.p1) if self.negative else (self.p1, self.p2)
        yield from joined(self.capacitor.p, to_pin.p, to_ground.p)
        yield from joined(self.capacitor.n, self.n1.p, self.n2.p)
        yield from joined(self.p, to_pin.n)
        yield from joined(self.n, self.n1.n)
        yield from joined(self.ground.p, to_ground.n, self.n2.n)


class CauerSC(CauerOPV):
    R1, R2, R3, R6, R7, R10, R11 = (SwitchedCapacitor() for _ in range(7))
    R4, R5, R8, R9 = (SwitchedCapacitor(negative=True) for _ in range(4))


def test_cauer_low_pass_with_amplifiers():
    compare(ANALOG + "CauerLowPassOPV", CauerOPV())


def test_cauer_low_pass_with_switched_capacitors():
    compare(ANALOG + "CauerLowPassSC", CauerSC(), intervals=6000)


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
    compare(ANALOG + "Rectifier", Rectifier())


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
