"""Amplifiers, oscillators and a control circuit of Modelica.Electrical.Analog.Examples.OpAmps."""

from __future__ import annotations

import numpy as np
import pytest

from acausal import Model, Scalar, clip, fixed, guess, port, variable
from components import blocks
from components import electrical as el
from tests.reference.msl.published import compare
from tests.reference.msl.test_circuits import ANALOG, joined
from tests.reference.msl.test_opamps import BOTH, Amplifier, OpAmp
from tests.reference.msl.test_sampled import Mean

OPAMPS = ANALOG + "OpAmps."


class Adder(Amplifier):
    source, vIn2 = el.SineVoltage(V=5, f=10), el.ConstantVoltage(V=5)
    r, r1, r2 = (el.Resistor(R=1000) for _ in range(3))
    before, around = ("r1",), ("r",)

    def connections(self):
        yield from super().connections()
        yield from joined(self.vIn2.p, self.r2.p)
        yield from joined(self.vIn2.n, self.ground.p)
        yield from joined(self.r2.n, self.opAmp.in_n)


class Subtracter(Model):
    opAmp, ground = OpAmp(), el.Ground()
    vIn1, vIn2 = el.SineVoltage(V=5, f=10), el.ConstantVoltage(V=5)
    r1, r2, r3, r4 = (el.Resistor(R=1000) for _ in range(4))

    def connections(self):
        yield from joined(self.ground.p, self.vIn1.n, self.vIn2.n, self.r4.n)
        yield from joined(self.vIn1.p, self.r1.p)
        yield from joined(self.vIn2.p, self.r2.p)
        yield from joined(self.opAmp.in_n, self.r1.n, self.r3.n)
        yield from joined(self.opAmp.in_p, self.r2.n, self.r4.p)
        yield from joined(self.opAmp.out, self.r3.p)


@pytest.mark.parametrize("model", [Adder, Subtracter])
def test_sums_and_differences(model):
    compare(OPAMPS + model.__name__, model(), {"vOut.v": lambda r: -r["opAmp.out.v"]})


class InvertingAmplifier(Amplifier):
    source = el.SignalVoltage(v=BOTH)
    r1, r2 = el.Resistor(R=1000), el.Resistor(R=2000)
    before, around = ("r1",), ("r2",)


class NonInvertingAmplifier(Model):
    opAmp, ground, vIn = OpAmp(), el.Ground(), el.SignalVoltage(v=BOTH)
    r1, r2 = el.Resistor(R=1000), el.Resistor(R=1000)

    def connections(self):
        yield from joined(self.ground.p, self.vIn.n, self.r1.n)
        yield from joined(self.vIn.p, self.opAmp.in_p)
        yield from joined(self.opAmp.in_n, self.r1.p, self.r2.n)
        yield from joined(self.opAmp.out, self.r2.p)


class VoltageFollower(Model):
    opAmp, ground, vIn = OpAmp(), el.Ground(), el.SignalVoltage(v=BOTH)
    ri, rl = el.Resistor(R=1), el.Resistor(R=1)

    def connections(self):
        yield from joined(self.ground.p, self.vIn.n, self.rl.n)
        yield from joined(self.vIn.p, self.ri.p)
        yield from joined(self.ri.n, self.opAmp.in_p)
        yield from joined(self.opAmp.out, self.opAmp.in_n, self.rl.p)


class InvertingSchmittTrigger(Model):
    opAmp, ground, vIn = OpAmp(), el.Ground(), el.SignalVoltage(v=BOTH)
    r1, r2 = el.Resistor(R=1000), el.Resistor(R=14000)

    def connections(self):
        yield from joined(self.ground.p, self.vIn.n, self.r1.n)
        yield from joined(self.vIn.p, self.opAmp.in_n)
        yield from joined(self.opAmp.in_p, self.r1.p, self.r2.n)
        yield from joined(self.opAmp.out, self.r2.p)


class Multivibrator(Model):
    opAmp, ground = OpAmp(), el.Ground()
    r, r1, r2 = (el.Resistor(R=1000) for _ in range(3))
    c = el.Capacitor(C=1 / 10 / (2 * 1000 * np.log(3)), v=fixed(1))

    def connections(self):
        yield from joined(self.ground.p, self.r1.n, self.c.n)
        yield from joined(self.opAmp.in_n, self.r.n, self.c.p)
        yield from joined(self.opAmp.in_p, self.r1.p, self.r2.n)
        yield from joined(self.opAmp.out, self.r.p, self.r2.p)


class LCOscillator(Model):
    opAmp, ground = OpAmp(), el.Ground()
    r, r1, r2 = el.Resistor(R=10000), el.Resistor(R=10000), el.Resistor(R=10)
    c = el.Capacitor(C=1 / ((2 * np.pi * 1000) ** 2 * 0.001), v=fixed(10))
    l = el.Inductor(L=0.001, i=fixed(0))

    def connections(self):
        yield from joined(self.ground.p, self.r1.n, self.l.n, self.c.n)
        yield from joined(self.opAmp.in_n, self.r1.p, self.r2.n)
        yield from joined(self.opAmp.in_p, self.r.n, self.l.p, self.c.p)
        yield from joined(self.opAmp.out, self.r.p, self.r2.p)


@pytest.mark.parametrize(
    ("model", "part"),
    [
        (InvertingAmplifier, "gain."),
        (NonInvertingAmplifier, "buffer."),
        (VoltageFollower, ""),
        (InvertingSchmittTrigger, ""),
        (Multivibrator, ""),
        (LCOscillator, ""),
    ],
)
def test_amplifiers(model, part):
    names = {f"{part}{own}": own for own in ("opAmp.out.v", "opAmp.out.i")}
    compare(OPAMPS + model.__name__, model(), names)


class SignalGenerator(Model):
    """Rectangles of the first amplifier, which starts at its lower limit, and triangles of the second one."""

    opAmp1, opAmp2, ground = OpAmp(v_in=guess(-6)), OpAmp(), el.Ground()
    r, r1, r2 = el.Resistor(R=1000), el.Resistor(R=1000), el.Resistor(R=1500)
    c = el.Capacitor(C=1.5 / (4 * 10 * 1000))

    def connections(self):
        yield from joined(self.ground.p, self.opAmp1.in_n, self.opAmp2.in_p)
        yield from joined(self.opAmp1.in_p, self.r1.p, self.r2.p)
        yield from joined(self.opAmp1.out, self.r2.n, self.r.p)
        yield from joined(self.opAmp2.in_n, self.r.n, self.c.n)
        yield from joined(self.opAmp2.out, self.c.p, self.r1.n)


def test_signal_generator():
    compare(OPAMPS + "SignalGenerator", SignalGenerator())


class Supplied(OpAmp):
    """Amplification of 10,000 within the potentials of a supply that gives its power."""

    s_p: el.Pin = port(el.Pin, "positive supply")
    s_n: el.Pin = port(el.Pin, "negative supply")
    i_s: Scalar = variable("current of the supply", unit="A")

    def equations(self):
        yield from super().equations()
        yield self.s_p.i == self.i_s
        yield self.s_n.i == -self.i_s
        yield self.i_s * (self.s_p.v - self.s_n.v) == -self.out.v * self.out.i

    def limited(self):
        return clip(10000 * self.v_in, self.s_n.v, self.s_p.v)


class DifferentialAmplifier(Model):
    """The reference of the amplifier is grounded by a resistor only."""

    ground, opAmp = el.Ground(), Supplied()
    sourceVoltage1 = el.SineVoltage(V=400 * np.sqrt(2 / 3), f=50, phase=np.pi / 3)
    sourceVoltage2 = el.SineVoltage(V=400 * np.sqrt(2 / 3), f=50, phase=-np.pi / 3)
    resistor1, resistor2 = el.Resistor(R=1e5), el.Resistor(R=1e5)
    resistor3, resistor4 = el.Resistor(R=1e3), el.Resistor(R=1e3)
    resistorGround, resistanceInstrument = el.Resistor(R=1e5), el.Resistor(R=1e5)
    positiveSupply, negativeSupply = el.ConstantVoltage(V=15), el.ConstantVoltage(V=-15)
    mean = Mean(f=50)

    def connections(self):
        yield from joined(self.ground.p, self.sourceVoltage1.n, self.sourceVoltage2.n, self.resistorGround.p)
        yield from joined(self.sourceVoltage1.p, self.resistor1.p)
        yield from joined(self.sourceVoltage2.p, self.resistor2.p)
        yield from joined(self.opAmp.in_n, self.resistor1.n, self.resistor3.p)
        yield from joined(self.opAmp.in_p, self.resistor2.n, self.resistor4.p)
        yield from joined(self.opAmp.out, self.resistor3.n, self.resistanceInstrument.p)
        yield from joined(self.opAmp.s_p, self.positiveSupply.p)
        yield from joined(self.opAmp.s_n, self.negativeSupply.p)
        yield from joined(self.resistorGround.n, self.resistor4.n, self.resistanceInstrument.n)
        yield from joined(self.resistorGround.n, self.positiveSupply.n, self.negativeSupply.n)

    def equations(self):
        yield self.mean.u == self.resistanceInstrument.v**2


def test_differential_amplifier():
    names = {"opAmp.v_out": "opAmp.out.v", "rootMeanSquare.mean.x": "mean.x"}
    compare(OPAMPS + "DifferentialAmplifier", DifferentialAmplifier(), names)


class ControlCircuit(Model):
    """A loop of amplifiers and one of blocks."""

    ground, stepA, step1A = el.Ground(), el.StepVoltage(V=10, start_time=0.1), el.StepVoltage(V=1, start_time=0.5)
    feedback, pi, add, lag1, lag2 = (OpAmp() for _ in range(5))
    before1, before2, around, to_ground, pi_in = (el.Resistor(R=1000) for _ in range(5))
    add1, add2, add_around, lag1_in, lag1_around, lag2_in, lag2_around = (el.Resistor(R=1000) for _ in range(7))
    pi_around, pi_c = el.Resistor(R=500), el.Capacitor(C=0.01 / 500)
    lag1_c, lag2_c = el.Capacitor(C=1e-5), el.Capacitor(C=1e-5)
    stepB, step1B = blocks.Step(height=10, start_time=0.1), blocks.Step(start_time=0.5)
    PIB = blocks.PI(k=0.5, T=0.01)
    firstOrder1B, firstOrder2B = blocks.FirstOrder(T=0.01), blocks.FirstOrder(T=0.01)

    def connections(self):
        yield from joined(self.ground.p, self.stepA.n, self.step1A.n, self.to_ground.n)
        yield from joined(self.ground.p, *(stage.in_p for stage in (self.pi, self.add, self.lag1, self.lag2)))
        yield from joined(self.stepA.p, self.before2.p)
        yield from joined(self.step1A.p, self.add2.p)
        yield from joined(self.feedback.in_p, self.before2.n, self.to_ground.p)
        yield from joined(self.feedback.in_n, self.before1.n, self.around.n)
        yield from joined(self.feedback.out, self.around.p, self.pi_in.p)
        yield from joined(self.pi.in_n, self.pi_in.n, self.pi_around.n)
        yield from joined(self.pi_around.p, self.pi_c.n)
        yield from joined(self.pi.out, self.pi_c.p, self.lag1_in.p)
        yield from joined(self.lag1.in_n, self.lag1_in.n, self.lag1_around.n, self.lag1_c.n)
        yield from joined(self.lag1.out, self.lag1_around.p, self.lag1_c.p, self.add1.p)
        yield from joined(self.add.in_n, self.add1.n, self.add2.n, self.add_around.n)
        yield from joined(self.add.out, self.add_around.p, self.lag2_in.p)
        yield from joined(self.lag2.in_n, self.lag2_in.n, self.lag2_around.n, self.lag2_c.n)
        yield from joined(self.lag2.out, self.lag2_around.p, self.lag2_c.p, self.before1.p)

    def equations(self):
        yield self.PIB.u == self.stepB.y - self.firstOrder2B.y
        yield self.firstOrder1B.u == self.PIB.y
        yield self.firstOrder2B.u == self.firstOrder1B.y + self.step1B.y


def test_control_circuit():
    names = {"PIA.c.v": "pi_c.v", "firstOrder1A.c.v": "lag1_c.v", "firstOrder2A.c.v": "lag2_c.v"}
    compare(OPAMPS + "ControlCircuit", ControlCircuit(), names)
