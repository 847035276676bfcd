"""Circuits against closed forms, scipy and balances."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import InitializationError, Model, Scalar, UnbalancedModelError, chain, connect, fixed, guess, output, sin
from acausal import time as now
from components import blocks, rotational, thermal
from components import electrical as el


class Circuit(Model):
    """A voltage source and a chain of parts in series, at ground."""

    ground = el.Ground()
    stop_time = 1.0

    def connections(self):
        yield chain(self.source.p, *self.parts(), self.source.n)
        yield connect(self.source.n, self.ground.p)


def series(source, **parts):
    """Return a circuit of a source and parts in series."""

    class Series(Circuit):
        def parts(self):
            return [getattr(self, name) for name in parts]

    cls = type("Series", (Series,), {"source": source, **parts, "__module__": __name__})
    return cls()


def balance(result):
    s = result.stats
    return s.energy_supplied - s.energy_dissipated - s.energy_stored_change


def test_resistor_and_capacitor():
    model = series(el.StepVoltage(V=10, start_time=0.1), r=el.Resistor(R=1000), c=el.Capacitor(C=1e-4))
    result = ac.simulate(model, tolerance=1e-8, energy=True)
    t = result.time
    np.testing.assert_allclose(result["c.v"], np.where(t < 0.1, 0, 10 * (1 - np.exp(-(t - 0.1) / 0.1))), atol=1e-6)
    assert balance(result) == pytest.approx(0, abs=1e-8)


def test_oscillating_circuit():
    model = series(
        el.ConstantVoltage(V=1),
        r=el.Resistor(R=2),
        coil=el.Inductor(L=0.1, i=fixed(0.5)),
        c=el.Capacitor(C=1e-3, v=fixed(3)),
    )
    result = ac.simulate(model, tolerance=1e-9)

    def rates(t, y):
        return [(1 - 2 * y[0] - y[1]) / 0.1, y[0] / 1e-3]

    exact = solve_ivp(rates, (0, 1), [0.5, 3], t_eval=result.time, rtol=1e-10, atol=1e-12).y
    np.testing.assert_allclose(result["c.v"], exact[1], atol=1e-6)


def late_sine(t):
    return 1 + 3 * np.sin(4 * np.pi * (t - 0.2) + 0.5) * (t >= 0.2)


SOURCES = [
    (el.SineVoltage(V=3, f=2, phase=0.5, offset=1, start_time=0.2), late_sine),
    (el.RampVoltage(V=3, duration=0.5, start_time=0.2), lambda t: 3 * np.clip((t - 0.2) / 0.5, 0, 1)),
    (el.PulseVoltage(V=3, width=30, period=0.4), lambda t: 3.0 * (t % 0.4 < 0.12)),
    (el.TableVoltage(data=ac.Table([0, 0.5, 1], [0, 2, 1])), lambda t: np.interp(t, [0, 0.5, 1], [0, 2, 1])),
]


@pytest.mark.parametrize(("source", "at"), SOURCES)
def test_sources(source, at):
    result = ac.simulate(series(source, r=el.Resistor(R=2)), intervals=97)
    np.testing.assert_allclose(result["r.i"], at(result.time) / 2, atol=1e-9)


def test_loops_of_capacitors_and_cut_sets_of_inductors():
    class Parallel(Model):
        ground, source = el.Ground(), el.ConstantCurrent(I=-1e-3)
        a, b = el.Capacitor(C=1e-4), el.Capacitor(C=3e-4)
        stop_time = 1

        def connections(self):
            for part in (self.a, self.b):
                yield connect(self.source.p, part.p)
                yield connect(self.source.n, part.n)
            yield connect(self.source.n, self.ground.p)

    assert ac.simulate(Parallel())["a.v"][-1] == pytest.approx(2.5)
    cut = series(el.ConstantVoltage(V=1), a=el.Inductor(L=1), b=el.Inductor(L=3))
    assert ac.simulate(cut)["a.i"][-1] == pytest.approx(0.25)


def test_contradictory_starts_are_named():
    with pytest.raises(InitializationError, match=r"c\.v = 0: off by 10"):
        ac.simulate(series(el.ConstantVoltage(V=10), c=el.Capacitor(C=1e-4)))
    for start in (guess(0), fixed(10)):
        result = ac.simulate(series(el.ConstantVoltage(V=10), c=el.Capacitor(C=1e-4, v=start)))
        assert result["c.v"][-1] == pytest.approx(10)


def test_a_circuit_without_ground_is_refused():
    class Floating(Model):
        source, r = el.ConstantVoltage(V=10), el.Resistor(R=1000)
        stop_time = 1

        def connections(self):
            yield connect(self.source.p, self.r.p)
            yield connect(self.source.n, self.r.n)

    with pytest.raises(
        UnbalancedModelError, match=r"(?s)source \(ConstantVoltage\).*r \(Resistor\).*No Ground fixes their level"
    ):
        ac.compile(Floating())


def test_heat_of_a_resistor():
    class Heated(Model):
        ground, source = el.Ground(), el.ConstantVoltage(V=10)
        r = el.Resistor(R=5, alpha=0.004, T_ref=300, use_heat_port=True)
        mass = thermal.HeatCapacitor(C=20, T=fixed(300))
        stop_time = 10

        def connections(self):
            yield chain(self.source.p, self.r, self.source.n)
            yield connect(self.source.n, self.ground.p)
            yield connect(self.r.heat_port, self.mass.port)

    result = ac.simulate(Heated(), tolerance=1e-9)
    # C T' = V^2 / (R (1 + alpha (T - T_ref)))
    exact = 300 + (np.sqrt(1 + 2 * 0.004 * 20 / 20 * result.time) - 1) / 0.004
    np.testing.assert_allclose(result["mass.T"], exact, atol=1e-5)


def test_transformers():
    class Coupled(Model):
        ground, source = el.Ground(), el.SineVoltage(V=10, f=5)
        r, load = el.Resistor(R=1), el.Resistor(R=3)
        coil = el.Transformer(L1=0.2, L2=0.3, M=0.15)
        stop_time = 1

        def connections(self):
            yield chain(self.source.p, self.r, self.coil.p1)
            yield connect(self.coil.n1, self.source.n)
            yield chain(self.coil.p2, self.load, self.coil.n2)
            yield connect(self.source.n, self.ground.p)
            yield connect(self.coil.n2, self.ground.p)

    result = ac.simulate(Coupled(), tolerance=1e-9)
    L = np.array([[0.2, 0.15], [0.15, 0.3]])

    def rates(t, i):
        return np.linalg.solve(L, [10 * np.sin(10 * np.pi * t) - i[0], -3 * i[1]])

    exact = solve_ivp(rates, (0, 1), [0, 0], t_eval=result.time, rtol=1e-10, atol=1e-12).y
    np.testing.assert_allclose(result["coil.i2"], exact[1], atol=1e-6)


@pytest.mark.parametrize("cls", [el.IdealClosingSwitch, el.IdealOpeningSwitch])
def test_switches(cls):
    model = series(
        el.ConstantVoltage(V=10), s=cls(control=ac.step(start_time=0.2)), coil=el.Inductor(L=0.1), r=el.Resistor(R=1)
    )
    result = ac.simulate(model, tolerance=1e-8, stop_time=0.5, intervals=97)
    closed = result.time - 0.2 if cls is el.IdealClosingSwitch else result.time
    on = (result.time >= 0.2) == (cls is el.IdealClosingSwitch)
    exact = np.where(on, 10 * (1 - np.exp(-10 * closed)), 0)
    np.testing.assert_allclose(result["coil.i"], exact, atol=2e-4)  # 1e-5 S of the open switch


def test_rectifier():
    """A capacitor behind a resistor and a diode, by scipy with the lines of the ideal diode."""

    class Half(Model):
        ground, source = el.Ground(), el.SineVoltage(V=10, f=50)
        rs, d = el.Resistor(R=1), el.IdealDiode()
        r, c = el.Resistor(R=100), el.Capacitor(C=1e-4)
        stop_time = 0.1

        def connections(self):
            yield chain(self.source.p, self.rs, self.d, self.r, self.source.n)
            yield connect(self.c.p, self.r.p)
            yield connect(self.c.n, self.r.n)
            yield connect(self.source.n, self.ground.p)

    result = ac.simulate(Half(), tolerance=1e-8, energy=True)

    def rate(t, v):
        drop = 10 * np.sin(100 * np.pi * t) - v[0]
        return [((drop / (1 + 1e-5) if drop > 0 else drop * 1e-5 / (1 + 1e-5)) - v[0] / 100) / 1e-4]

    exact = solve_ivp(rate, (0, 0.1), [0], t_eval=result.time, rtol=1e-9, atol=1e-10, max_step=1e-4).y[0]
    np.testing.assert_allclose(result["c.v"], exact, atol=1e-5)
    assert result.stats.events == 9
    assert balance(result) == pytest.approx(0, abs=1e-6)


class Bridge(Model):
    """Six-pulse rectifier from three sine sources, which feeds a DC machine with a fan."""

    ground = el.Ground()
    a = el.SineVoltage(V=60, f=50)
    b = el.SineVoltage(V=60, f=50, phase=-2 * np.pi / 3)
    c = el.SineVoltage(V=60, f=50, phase=2 * np.pi / 3)
    la, lb, lc = (el.Inductor(L=1e-4) for _ in range(3))
    d1, d2, d3, d4, d5, d6 = (el.IdealDiode() for _ in range(6))
    machine = el.DCPermanentMagnet()
    fan = rotational.QuadraticSpeedDependentTorque(tau_nominal=-60, w_nominal=149)
    i: Scalar = output("current of the machine", unit="A")
    w: Scalar = output("speed of the machine", unit="rad/s")
    stop_time = 0.6

    def connections(self):
        legs = (
            (self.a, self.la, self.d1, self.d4),
            (self.b, self.lb, self.d2, self.d5),
            (self.c, self.lc, self.d3, self.d6),
        )
        for source, coil, upper, lower in legs:
            yield connect(source.n, self.ground.p)
            yield chain(source.p, coil, upper.p)
            yield connect(upper.p, lower.n)
            yield connect(upper.n, self.machine.pin_ap)
            yield connect(lower.p, self.machine.pin_an)
        yield connect(self.machine.flange, self.fan.flange)

    def equations(self):
        yield self.i == self.machine.ia
        yield self.w == self.machine.w_mechanical

    def initial_equations(self):
        yield self.machine.w_mechanical == 0
        yield self.machine.phi_mechanical == 0


def test_six_pulse_bridge():
    result = ac.simulate(Bridge(), energy=True)
    assert result.stats.events == pytest.approx(12 * 50 * 0.6, abs=6)  # each diode goes on and off once a period
    late = result.time > 0.5
    i, w = np.mean(result["i"][late]), np.mean(result["w"][late])
    k = (100 - 0.05 * 100) / (1425 * 2 * np.pi / 60)
    # Mohan, Undeland, Robbins 2003, 5.6: mean voltage with commutation, less the drop of two diodes.
    mean = 3 * np.sqrt(3) / np.pi * 60 - 3 * 100 * np.pi * 1e-4 / np.pi * i - 2e-5 * i
    assert k * w + 0.05 * i == pytest.approx(mean, rel=2e-3)
    assert balance(result) == pytest.approx(0, abs=1e-4 * result.stats.energy_supplied)


def test_thyristor():
    class Fired(Model):
        ground, source = el.Ground(), el.SineVoltage(V=10, f=50)
        thyristor, r = el.IdealThyristor(), el.Resistor(R=10)
        pulse = blocks.BooleanPulse(width=10, period=0.02, start_time=0.003)
        stop_time = 0.04

        def connections(self):
            yield chain(self.source.p, self.thyristor, self.r, self.source.n)
            yield connect(self.source.n, self.ground.p)
            yield connect(self.pulse.y, self.thyristor.fire)

    result = ac.simulate(Fired(), intervals=1000)
    phase = result.time % 0.02
    exact = np.where((phase > 0.003) & (phase < 0.01), np.sin(100 * np.pi * phase), 0)
    assert np.mean(np.abs(result["r.i"] - exact) > 2e-4) < 0.01


def test_operational_amplifiers():
    class Inverting(Model):
        ground, source = el.Ground(), el.SineVoltage(V=2, f=1)
        r1, r2 = el.Resistor(R=1000), el.Resistor(R=3000)
        op = el.IdealOpAmp3Pin()
        y: Scalar = output("output", unit="V")
        stop_time = 1

        def connections(self):
            yield chain(self.source.p, self.r1, self.op.in_n)
            yield chain(self.op.in_n, self.r2, self.op.out)
            yield connect(self.op.in_p, self.ground.p)
            yield connect(self.source.n, self.ground.p)

        def equations(self):
            yield self.y == self.op.out.v

    result = ac.simulate(Inverting())
    np.testing.assert_allclose(result["y"], -6 * np.sin(2 * np.pi * result.time), atol=1e-9)

    class Limited(Inverting):
        op = el.IdealOpAmpLimited()
        upper, lower = el.ConstantVoltage(V=4), el.ConstantVoltage(V=-3)

        def connections(self):
            yield from super().connections()
            for source, pin in ((self.upper, self.op.VMax), (self.lower, self.op.VMin)):
                yield connect(source.p, pin)
                yield connect(source.n, self.ground.p)

    result = ac.simulate(Limited(), tolerance=1e-8)
    np.testing.assert_allclose(result["y"], np.clip(-6 * np.sin(2 * np.pi * result.time), -3, 4), atol=1e-6)


@pytest.mark.parametrize("excited", [False, True])
def test_machines_start(excited):
    class Start(Model):
        ground, source = el.Ground(), el.ConstantVoltage(V=100)
        machine = el.DCElectricalExcited(ie=fixed(1)) if excited else el.DCPermanentMagnet()
        load = rotational.Inertia(J=0.15, w=fixed(0), phi=fixed(0))
        stop_time = 1

        def connections(self):
            yield connect(self.source.p, self.machine.pin_ap)
            yield connect(self.source.n, self.machine.pin_an)
            yield connect(self.source.n, self.ground.p)
            yield connect(self.machine.flange, self.load.flange_a)
            if excited:
                yield connect(self.source.p, self.machine.pin_ep)
                yield connect(self.source.n, self.machine.pin_en)

    result = ac.simulate(Start(), tolerance=1e-8, energy=True)
    k = (100 - 0.05 * 100) / (1425 * 2 * np.pi / 60)

    def rates(t, y):
        return [(100 - 0.05 * y[0] - k * y[1]) / 0.0015, k * y[0] / 0.3]

    exact = solve_ivp(rates, (0, 1), [0, 0], t_eval=result.time, rtol=1e-10, atol=1e-10).y
    np.testing.assert_allclose(result["machine.w_mechanical"], exact[1], atol=1e-4)
    assert balance(result) == pytest.approx(0, abs=1e-4 * result.stats.energy_supplied)


def test_sensors_and_converters():
    class Drive(Model):
        ground, source = el.Ground(), el.SignalVoltage(v=5 * sin(now))
        amps, volts, potential, power = el.CurrentSensor(), el.VoltageSensor(), el.PotentialSensor(), el.PowerSensor()
        r, emf = el.Resistor(R=2), el.RotationalEMF(k=0.5)
        wheel = rotational.Inertia(J=0.1, w=fixed(0), phi=fixed(0))
        stop_time = 2

        def connections(self):
            yield chain(self.source.p, self.amps, self.power, self.r, self.emf, self.source.n)
            yield connect(self.volts.p, self.source.p)
            yield connect(self.volts.n, self.source.n)
            yield connect(self.potential.p, self.source.p)
            yield connect(self.power.pv, self.source.p)
            yield connect(self.power.nv, self.ground.p)
            yield connect(self.source.n, self.ground.p)
            yield connect(self.emf.flange, self.wheel.flange_a)

    result = ac.simulate(Drive(), tolerance=1e-9)
    u = 5 * np.sin(result.time)
    for name in ("volts.v", "potential.phi"):
        np.testing.assert_allclose(result[name], u, atol=1e-12)
    np.testing.assert_allclose(result["power.power"], u * result["amps.i"], atol=1e-12)
    exact = solve_ivp(
        lambda t, w: [0.5 * (5 * np.sin(t) - 0.5 * w[0]) / 2 / 0.1],
        (0, 2),
        [0],
        t_eval=result.time,
        rtol=1e-10,
        atol=1e-12,
    ).y[0]
    np.testing.assert_allclose(result["wheel.w"], exact, atol=1e-6)
