"""Circuits with thyristors and Zener diodes of Modelica.Electrical.Analog.Examples."""

from __future__ import annotations

import numpy as np

from acausal import Component, Model, Scalar, connect, der, exp, fixed, input, piecewise, port, quantity, variable
from components import blocks
from components import electrical as el
from tests.reference.msl.published import compare
from tests.reference.msl.test_circuits import ANALOG, joined
from tests.reference.msl.test_logic import BooleanTable


class GTO(el.IdealDiode):
    """A thyristor that is off without a signal at its gate."""

    fire: Scalar = input("truth value")

    def open(self):
        return (self.s < 0) | (self.fire <= 0.5)


class Thyristors(Model):
    Ground1, SineVoltage1 = el.Ground(), el.SineVoltage(V=10, f=1)
    IdealThyristor1, IdealThyristor2 = el.IdealThyristor(Vknee=1), el.IdealThyristor(Vknee=1)
    IdealGTOThyristor1, IdealGTOThyristor2 = GTO(Vknee=1), GTO(Vknee=1)
    R1, R2, R3, R4 = (el.Resistor(R=1e-3) for _ in range(4))
    booleanStep1 = BooleanTable(times=(1.25, 3.2, 4.2, 4.25, 5.7, 5.72))
    booleanPulse = blocks.BooleanPulse(width=20, period=1, start_time=0.15)

    def connections(self):
        yield from joined(self.SineVoltage1.n, self.Ground1.p)
        for valve, r, gate in (
            (self.IdealThyristor1, self.R3, self.booleanStep1),
            (self.IdealGTOThyristor1, self.R1, self.booleanStep1),
            (self.IdealThyristor2, self.R2, self.booleanPulse),
            (self.IdealGTOThyristor2, self.R4, self.booleanPulse),
        ):
            yield from joined(self.SineVoltage1.p, valve.p)
            yield from joined(valve.n, r.p)
            yield from joined(r.n, self.Ground1.p)
            yield connect(gate.y, valve.fire)


def off(path):
    return lambda result: 1 - result[f"{path}.on"]


def test_characteristics_of_thyristors():
    names = {f"{name}.off": off(name) for name in ("IdealThyristor1", "IdealThyristor2")}
    compare(ANALOG + "CharacteristicThyristors", Thyristors(), names)


class Triac(Model):
    ground, V, R = el.Ground(), el.SineVoltage(V=5, f=2), el.Resistor(R=20)
    idealThyristor, idealThyristor1 = el.IdealThyristor(Vknee=0.8), el.IdealThyristor(Vknee=0.8)
    resistor, capacitor = el.Resistor(R=100), el.Capacitor(C=0.005)
    booleanPulse = blocks.BooleanPulse(period=0.25, start_time=0.1)

    def connections(self):
        yield from joined(self.V.p, self.R.p)
        yield from joined(self.R.n, self.idealThyristor.p, self.idealThyristor1.n, self.resistor.p)
        yield from joined(self.resistor.n, self.capacitor.p)
        yield from joined(self.V.n, self.ground.p, self.idealThyristor.n, self.idealThyristor1.p, self.capacitor.n)
        yield connect(self.booleanPulse.y, self.idealThyristor.fire)
        yield connect(self.booleanPulse.y, self.idealThyristor1.fire)


def test_ideal_triac():
    names: dict = {f"idealTriac.{name}.off": off(name) for name in ("idealThyristor", "idealThyristor1")}
    compare(ANALOG + "IdealTriacCircuit", Triac(), {**names, "idealTriac.capacitor.v": "capacitor.v"})


class Thyristor(Component):
    """Simple thyristor with the default parameters."""

    Anode: el.Pin = port(el.Pin, "anode")
    Cathode: el.Pin = port(el.Pin, "cathode")
    Gate: el.Pin = port(el.Pin, "gate")
    vControl: Scalar = variable("control voltage", unit="V", start=0, fixed=True)

    def equations(self):
        i, gate, control = self.Anode.i, self.Gate.i, self.vControl
        vAK, vGK = self.Anode.v - self.Cathode.v, self.Gate.v - self.Cathode.v
        r_on, r_off = 1 / 25, 100**2 / 1.7 / 6e-3
        yield self.Anode.i + self.Gate.i + self.Cathode.i == 0
        yield vGK == piecewise((0.7 / 5e-3 * gate, vGK < 0.65), 0.65**2 / 0.7 + 0.05 / 5e-3 * gate)
        main = piecewise((5, (i > 6e-3) | (vAK > 100)), 0)
        total = main + piecewise((0, gate < 4.75e-3), (1e4 * (gate - 4.75e-3) * vAK, gate < 5.75e-3), 10 * vAK)
        yield der(control) == (total - control) / piecewise((1.87e-6, total > control), 0.638 * 15e-6)
        u = (2 * control - 6.5) / 7
        partly = (r_on * r_off) ** 0.5 * (r_on / r_off) ** ((3 * u - 4 * u**3) / 2)
        broken = -100 / r_off * exp(-(vAK + 100) / (0.74 * 0.04))
        yield i == piecewise(
            (broken, vAK < -100), (vAK / r_off, control < 1.5), (vAK / partly, control < 5), vAK / r_on
        )


class FiredThyristor(Model):
    ground, sineVoltage, resistor = el.Ground(), el.SineVoltage(V=30, f=10000), el.Resistor(R=10)
    pulseCurrent = el.PulseCurrent(I=0.005, width=10, period=1e-4, start_time=2e-5)
    thyristor_v4_1, inductor = Thyristor(), el.Inductor(L=2e-6, i=fixed(0))

    def connections(self):
        yield from joined(self.sineVoltage.p, self.thyristor_v4_1.Anode)
        yield from joined(self.thyristor_v4_1.Cathode, self.resistor.p, self.pulseCurrent.p)
        yield from joined(self.pulseCurrent.n, self.thyristor_v4_1.Gate)
        yield from joined(self.resistor.n, self.inductor.p)
        yield from joined(self.inductor.n, self.sineVoltage.n, self.ground.p)


def test_thyristor():
    compare(ANALOG + "ThyristorBehaviourTest", FiredThyristor(), run=1e-8)


class ZDiode(el.OnePort):
    """Zener diode of 5.1 V."""

    def equations(self):
        yield from super().equations()
        v = self.v / quantity(1, "V")
        forward, beyond = v / 0.04, -(v + 5.1) / (0.74 * 0.04)
        conducts = 1e-6 * (np.exp(30) * (1 + forward - 30) - 1)
        breaks = -1e-6 - 0.7 * np.exp(30) * (1 + beyond - 30)
        between = 1e-6 * (exp(forward) - 1) - 0.7 * exp(beyond)
        current = piecewise((conducts, forward > 30), (breaks, beyond > 30), between) + v / 1e8
        yield self.i == quantity(current, "A")


class Protection(Model):
    sineVoltage, ground = el.SineVoltage(V=10, f=5), el.Ground()
    Rv, RL, CL = el.Resistor(R=20), el.Resistor(R=2000), el.Capacitor(C=1e-7)
    zDiode, zDiode1 = ZDiode(), ZDiode()

    def connections(self):
        yield from joined(self.sineVoltage.p, self.Rv.p)
        yield from joined(self.Rv.n, self.zDiode1.p, self.RL.p, self.CL.p)
        yield from joined(self.zDiode1.n, self.zDiode.n)
        yield from joined(self.sineVoltage.n, self.ground.p, self.zDiode.p, self.RL.n, self.CL.n)


def test_overvoltage_protection():
    compare(ANALOG + "OvervoltageProtection", Protection())
