"""Every block and every circuit element against every property: none forgotten, its equations hold, its powers add up."""

from __future__ import annotations

import inspect
from functools import cache

import casadi as ca
import pytest

import acausal as ac
from acausal import Connector, Model, Table, connect, fixed, pulse, sin
from acausal import time as now
from acausal.language import fields as f
from components import electrical as el
from components import rotational, translational
from tests.components.test_properties import SIGNALS
from tests.shared import worst_equation

PARTS = {n: c for n, c in SIGNALS.items() if not (issubclass(c, Connector) or inspect.getdoc(c).startswith("Base"))}
BLOCKS = [name for name in PARTS if name.startswith("blocks.")]
CIRCUITS = [name for name in PARTS if name.startswith("electrical.") and name != "electrical.Ground"]
NUMBER = ca.SX.sym("number")
DATA = {
    "CombiTable2D": Table(([0, 1, 3], [0, 2, 3]), [[0, 1, 2], [1, 3, 2], [2, 1, 0]]),
    **dict.fromkeys(
        ("CombiTable1D", "CombiTimeTable", "TableCurrent", "TableVoltage"), Table([0, 0.3, 1, 3], [0, 2, 1, 2])
    ),
}
NEEDED = {
    "Sampled": {"f": lambda time, u: 2 * u},
    "CasadiFunction": {"f": ca.Function("sine", [NUMBER], [ca.sin(NUMBER)])},
    "DiscreteStateSpace": {"A": [[0.5]], "B": [[1]], "C": [[2]]},
}
WAVE, OTHER, LIGHT = 1.5 + sin(7 * now), 1.2 + sin(11 * now + 1) / 2, pulse(width=0.5, period=0.3, start_time=0.05)
LOGIC = {"And", "Or", "Xor", "Not", "Timer", "RSFlipFlop"}
LOGICAL = {"trigger", "control", "fire", "reset"}


def signals(name):
    """Return the part, and a signal for each of its inputs."""
    cls = PARTS[name]
    inputs = [n for n, d in cls.fields.items() if getattr(d, "causality", "") == "input"]
    given = dict(zip(inputs, (WAVE, OTHER, -WAVE), strict=False))
    logical = LOGICAL | ({"u2"} if cls.__name__ == "Switch" else set(inputs) if cls.__name__ in LOGIC else set())
    given |= {n: LIGHT for n in logical if n in given}
    given |= {"u": (WAVE,)} if cls.__name__ in ("StateSpace", "DiscreteStateSpace", "CasadiFunction") else {}
    given |= {"limit2": -OTHER} if "limit2" in given else {}
    return cls, given, {"data": DATA[cls.__name__]} if cls.__name__ in DATA else NEEDED.get(cls.__name__, {})


def with_block(name):
    """Return a block between signals."""
    cls, given, data = signals(name)

    return type("Alone", (Model,), {"it": cls(**data, **given), "__module__": __name__})()


class Around(Model):
    """A sine behind a resistor, and what the ports of an element may need."""

    source, supply, ground = el.SineVoltage(V=3, f=2), el.ConstantVoltage(V=10), el.Ground()
    inner, load = el.Resistor(R=2), el.Resistor(R=5)
    wheel = rotational.Inertia(J=0.1, phi=fixed(0), w=fixed(0))
    slide = translational.Mass(m=0.1, s=fixed(0), v=fixed(0))

    def connections(self):
        zero, end = self.ground.p, self.inner.n
        yield connect(self.source.p, self.inner.p)
        yield connect(self.source.n, zero)
        yield connect(self.supply.n, zero)
        for one, other in self.around(zero, end, lambda name: getattr(self.it, name)):
            yield connect(one, other)

    def around(self, zero, end, port):
        """Yield the ports that are connected: the element leads to ground, and the load is beside or behind it."""
        ports, opened = ports_of(type(self.it)), (self.load.n, zero)
        if type(self.it) is el.PowerSensor:
            yield from ((port("pc"), end), (port("pv"), end), (port("nv"), zero), (port("nc"), self.load.p), opened)
        elif "in_n" in ports or type(self.it) is el.IdealOpAmp:
            low, high, out = ("in_n", "in_p", "out") if "in_n" in ports else ("n1", "p1", "p2")
            yield from ((port(low), end), (port(high), zero), (port(out), self.load.p), (self.load.n, end))
        elif "p1" in ports:
            yield from ((port("p1"), end), (port("n1"), zero), (port("p2"), self.load.p), opened)
        else:
            first, last = ("pin_ap", "pin_an") if "pin_ap" in ports else ("p", "n")
            yield from ((port(first), end), (self.load.p, end), opened)
            yield from [(port(last), zero)] if last in ports else []
        places = {"n2": zero, "control": self.source.p, "VMax": self.supply.p, "VMin": zero, "pin_ep": self.supply.p}
        moved = self.slide if type(self.it) is el.TranslationalEMF else self.wheel
        places |= {"pin_en": zero, "flange": moved.flange_a}
        yield from [(port(name), place) for name, place in places.items() if name in ports]


def ports_of(cls):
    """Return the names of the ports that are always there."""
    return {n for n, d in cls.fields.items() if isinstance(d, f.Part) and d.is_port}


def with_element(name):
    """Return an element in a circuit."""
    cls, given, data = signals(name)
    return type("With", (Around,), {"it": cls(**data, **given), "__module__": __name__})()


@cache
def ran(name):
    model = ac.compile((with_block if name in BLOCKS else with_element)(name))
    return model, ac.simulate(model, stop_time=1.0, tolerance=1e-7, intervals=70, energy=name in CIRCUITS)


@pytest.mark.parametrize("name", [*BLOCKS, *CIRCUITS])
def test_every_equation_holds(name):
    model, result = ran(name)
    assert worst_equation(result, model) < 1e-9


@pytest.mark.parametrize("name", CIRCUITS)
def test_power_balance(name):
    """The sources supply what is dissipated and stored."""
    _, result = ran(name)
    s = result.stats
    exchanged = abs(s.energy_supplied) + s.energy_dissipated + abs(s.energy_stored_change)
    assert exchanged > 0.01
    assert s.energy_dissipated > 0
    assert abs(s.energy_method) < 1e-5 * exchanged
