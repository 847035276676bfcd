"""Logic of Modelica.Blocks.Examples and ModelicaTest.Blocks."""

from __future__ import annotations

from typing import Any

from acausal import (
    Component,
    Model,
    Scalar,
    connect,
    discrete,
    fixed,
    input,
    maximum,
    parameter,
    piecewise,
    reinit,
    structural,
    time,
    variable,
    when,
)
from components import blocks
from tests.reference.msl.published import compare


class BooleanTable(blocks.SO):
    """True from the first instant on, false from the second, and so on."""

    times: Any = structural("instants")

    def equations(self):
        yield self.y == piecewise(*((k % 2, time < t) for k, t in enumerate(self.times)), len(self.times) % 2)


def pulses(width, period):
    """Pulses until 10 s; the first begins at the start without an edge there, as in Modelica."""
    return BooleanTable(times=[begin + end for begin in range(0, 10, period) for end in (0, width)] + [10])


class LogicalNetwork(Model):
    table1, table2 = BooleanTable(times=(2, 4, 6, 8)), BooleanTable(times=(1, 3, 5, 7))
    Not1, And1, Or1 = blocks.Not(), blocks.And(), blocks.Or()
    before: Scalar = discrete("output of Or1, just before an event", start=0)

    def connections(self):
        yield connect(self.table2.y, self.Not1.u)
        yield connect(self.Not1.y, self.And1.u1)
        yield connect(self.table1.y, self.Or1.u1)
        yield connect(self.And1.y, self.Or1.u2)

    def equations(self):
        yield self.And1.u2 == self.before
        yield when(self.Or1.y > 0.5, reinit(self.before, 1), at_start=True)
        yield when(self.Or1.y < 0.5, reinit(self.before, 0), at_start=True)


def test_logical_network():
    compare("Modelica.Blocks.Examples.LogicalNetwork1", LogicalNetwork(), {"Pre1.u": "Or1.y"})


class SampleTrigger(blocks.SO):
    """True at equidistant instants."""

    period: Scalar = parameter("period", unit="s", default=0.5)
    start_time: Scalar = parameter("first instant", unit="s", default=0)
    fires: Scalar = discrete("whether it is an instant", start=0)
    due: Scalar = discrete("next instant", unit="s", start=start_time)

    def equations(self):
        yield when(time >= self.due, reinit(self.fires, 1), reinit(self.due, self.due + self.period), at_start=True)
        yield when(self.fires > 0.5, reinit(self.fires, 0))
        yield self.y == self.fires


class BooleanNetwork(Model):
    booleanPulse1, booleanPulse2 = blocks.BooleanPulse(width=20), pulses(0.8, 1)
    booleanStep = blocks.BooleanStep(start_time=1.5)
    two, and1, or1, xor1 = blocks.And(), blocks.And(), blocks.Or(), blocks.Xor()
    rSFlipFlop = blocks.RSFlipFlop()
    sampleTriggerSet, sampleTriggerReset = SampleTrigger(), SampleTrigger(start_time=0.3)
    set1: Scalar = discrete("set by falling, reset by rising edges", start=0)
    triggeredAdd: Scalar = discrete("sum of 2 at each edge", start=0)

    def connections(self):
        yield connect(self.booleanPulse1.y, self.two.u1)
        yield connect(self.booleanStep.y, self.two.u2)
        yield connect(self.two.y, self.and1.u1)
        yield connect(self.and1.y, self.or1.u1)
        yield connect(self.or1.y, self.xor1.u1)
        for gate in (self.and1, self.or1, self.xor1):
            yield connect(self.booleanPulse2.y, gate.u2)
        yield connect(self.sampleTriggerSet.y, self.rSFlipFlop.S)
        yield connect(self.sampleTriggerReset.y, self.rSFlipFlop.R)

    def equations(self):
        pulse = self.booleanPulse2.y
        yield when(pulse > 0.5, reinit(self.set1, 0), reinit(self.triggeredAdd, self.triggeredAdd + 2))
        yield when(pulse < 0.5, reinit(self.set1, 1), reinit(self.triggeredAdd, self.triggeredAdd + 2))


def test_boolean_network():
    names = {"and1.u[1]": "booleanPulse1.y", "or1.u[1]": "and1.y", "xor1.u[1]": "or1.y"}
    names |= {"set1.y": "set1", "triggeredAdd.y": "triggeredAdd", "rSFlipFlop.pre.u": "rSFlipFlop.QI"}
    compare("Modelica.Blocks.Examples.BooleanNetwork1", BooleanNetwork(), names)


class IntegerNetwork(Model):
    booleanPulse1, booleanPulse2 = pulses(0.5, 1), pulses(1.6, 2)
    triggeredAdd: Scalar = discrete("sum of 1 at each rising edge", start=0)
    multiSwitch1: Scalar = variable("4 and 6 by the first true pulse, else 2")

    def equations(self):
        first, second = self.booleanPulse1.y > 0.5, self.booleanPulse2.y > 0.5
        yield when(first, reinit(self.triggeredAdd, self.triggeredAdd + 1))
        yield self.multiSwitch1 == piecewise((4, first), (6, second), 2)


def test_integer_network():
    names = {f"{name}.y": name for name in ("triggeredAdd", "multiSwitch1")}
    compare("Modelica.Blocks.Examples.IntegerNetwork1", IntegerNetwork(), names)


class OnDelay(blocks.SISO):
    """True a second after the input has become true, and until it becomes false."""

    delaySignal: Scalar = discrete("whether the input is true", start=0)
    t_next: Scalar = discrete("end of the delay", unit="s", start=-1)

    def equations(self):
        yield when(self.u > 0.5, reinit(self.delaySignal, 1), reinit(self.t_next, time + 1))
        yield when(self.u < 0.5, reinit(self.delaySignal, 0), reinit(self.t_next, time - 1))
        yield self.y == piecewise((1, (self.delaySignal > 0.5) & (time >= self.t_next)), 0)


class Delays(Model):
    booleanTable, booleanStep2 = BooleanTable(times=(1, 4, 6, 8, 9, 9.5)), blocks.BooleanStep(start_time=2)
    booleanStep3 = blocks.BooleanStep(start_time=2, start_value=1)
    onDelay1, onDelay2, onDelay3 = OnDelay(), OnDelay(), OnDelay(delaySignal=fixed(1))

    def connections(self):
        yield connect(self.booleanTable.y, self.onDelay1.u)
        yield connect(self.booleanStep2.y, self.onDelay2.u)
        yield connect(self.booleanStep3.y, self.onDelay3.u)


def test_delays_of_rising_edges():
    compare("ModelicaTest.Blocks.OnDelay", Delays())


class OnOffController(Component):
    """On below a band of 0.5 about the reference, off above it."""

    reference: Scalar = input("reference")
    u: Scalar = input("measurement")
    y: Scalar = discrete("1: on, 0: off", start=0)

    def equations(self):
        yield when(self.u < self.reference - 0.25, reinit(self.y, 1), at_start=True)
        yield when(self.u >= self.reference + 0.25, reinit(self.y, 0), at_start=True)


class TriggeredTrapezoid(blocks.SISO):
    """Rises to 1 in a second when the input becomes true, and falls to 0 in half a second when it becomes false."""

    endValue: Scalar = discrete("value at the end", start=0)
    rate: Scalar = discrete("derivative until the end", unit="1/s", start=-2)
    T: Scalar = discrete("end", unit="s", start=0)

    def equations(self):
        yield self.y == self.endValue - self.rate * maximum(0, self.T - time)
        yield when(self.u > 0.5, reinit(self.endValue, 1), reinit(self.rate, 1), reinit(self.T, time + (1 - self.y)))
        yield when(self.u < 0.5, reinit(self.endValue, 0), reinit(self.rate, -2), reinit(self.T, time + self.y / 2))


class Logical(Model):
    table1, table2 = BooleanTable(times=(2, 4, 6, 8)), BooleanTable(times=(1, 3, 5, 7))
    sine, ramp = blocks.Sine(amplitude=2, f=0.5), blocks.Ramp(height=5, duration=8)
    and1, or1, not1 = blocks.And(), blocks.Or(), blocks.Not()
    greaterThreshold = blocks.GreaterThreshold(threshold=0.1)
    hysteresis, timer = blocks.Hysteresis(u_low=-0.5, u_high=0.5), blocks.Timer()
    onOffController, triggeredTrapezoid = OnOffController(), TriggeredTrapezoid()

    def connections(self):
        yield connect(self.table1.y, self.and1.u1)
        yield connect(self.table2.y, self.and1.u2)
        yield connect(self.and1.y, self.or1.u1)
        yield connect(self.table2.y, self.or1.u2)
        yield connect(self.or1.y, self.not1.u)
        yield connect(self.sine.y, self.greaterThreshold.u)
        yield connect(self.sine.y, self.hysteresis.u)
        yield connect(self.sine.y, self.onOffController.reference)
        yield connect(self.ramp.y, self.onOffController.u)
        yield connect(self.table2.y, self.triggeredTrapezoid.u)
        yield connect(self.table2.y, self.timer.u)


def test_logical_blocks():
    names = {"change1.u": "or1.y", "pre1.u": "not1.y", "timer.entryTime": "timer.entry"}
    compare("ModelicaTest.Blocks.Logical", Logical(), {**names, "zeroCrossing.enable": "greaterThreshold.y"})


class ResetAndHold(Model):
    """An integrator that is reset at the falling edges of a pulse and held until it rises."""

    booleanPulse, inverse, fallingEdge = blocks.BooleanPulse(), blocks.Not(), blocks.Edge()
    switch, integrator = blocks.Switch(u1=1, u3=0), blocks.Integrator(k=2, use_reset=True)

    def connections(self):
        yield connect(self.booleanPulse.y, self.switch.u2)
        yield connect(self.switch.y, self.integrator.u)
        yield connect(self.booleanPulse.y, self.inverse.u)
        yield connect(self.inverse.y, self.fallingEdge.u)
        yield connect(self.fallingEdge.y, self.integrator.reset)


def test_an_integrator_that_is_reset_and_held():
    compare("ModelicaTest.Blocks.ResetHoldIntegrator", ResetAndHold())
