"""Energies of a run: quadrature on values that satisfy the equations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad, simpson

import acausal as ac
from acausal import (
    Model,
    Scalar,
    chain,
    connect,
    cos,
    der,
    exp,
    fixed,
    piecewise,
    quantity,
    reinit,
    sin,
    time,
    variable,
    when,
)
from components import rotational
from models import SCENES
from tests.acausal.solve.machines import Cranked, Two, Wound
from tests.shared import compiled, pairwise


@pytest.mark.parametrize(
    ("tolerance", "intervals", "method"),
    pairwise([1e-3, 1e-4, 1e-6, 1e-8, 1e-10], [400, 10, 3], ["idas", "rosenbrock"]),
)
def test_work_of_winding_a_spring(tolerance, intervals, method):
    stats = ac.simulate(
        compiled(Wound), stop_time=1.0, tolerance=tolerance, intervals=intervals, method=method, energy=True
    ).stats
    assert stats["energy_supplied"] == pytest.approx(10 * 0.5**2 / 2, rel=1e-9)
    assert abs(stats["energy_method"]) < 1e-9


@pytest.mark.parametrize(
    ("tolerance", "intervals", "method"), pairwise([1e-3, 1e-4, 1e-6, 1e-8, 1e-10], [400, 10], ["idas", "rosenbrock"])
)
def test_work_of_a_crank_at_constant_speed(tolerance, intervals, method):
    """The crank turns by 3.9 rad: the spring's energy there and at the start is in closed form."""
    stats = ac.simulate(
        compiled(Cranked), stop_time=1.3, tolerance=tolerance, intervals=intervals, method=method, energy=True
    ).stats

    def stretch(phi: float) -> float:
        return float(np.hypot(1 - 0.3 * np.cos(phi), 0.2 - 0.3 * np.sin(phi))) - 0.1

    exact = 1e3 / 2 * (stretch(3.9) ** 2 - stretch(0.0) ** 2)
    assert stats["energy_supplied"] == pytest.approx(exact, rel=max(tolerance, 1e-9))
    assert stats["energy_stored_change"] == pytest.approx(exact, rel=1e-9)


class Spinning(Cranked):
    """Ten times as fast."""

    drive = rotational.Speed(w_ref=30 + 1e-12 * time, phi=fixed(0))


@pytest.mark.parametrize("method", ["idas", "rosenbrock"])
@pytest.mark.parametrize(("stop", "intervals"), [(1.0, 10), (50.0, 400), (80 * np.pi / 3, 400)])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-7])
def test_work_of_many_turns(tolerance, stop, intervals, method):
    """The integrator's steps are far longer than a turn; the last stop has two whole turns in each interval."""
    stats = ac.simulate(
        compiled(Spinning), stop_time=stop, tolerance=tolerance, intervals=intervals, method=method, energy=True
    ).stats
    turned = np.array([0.0, 30 * stop])
    s = np.hypot(1 - 0.3 * np.cos(turned), 0.2 - 0.3 * np.sin(turned)) - 0.1
    exact = float(np.diff(1e3 / 2 * s**2)[0])
    # Each turn lifts and lowers this much.
    gross = 1e3 / 2 * (1.25**2 - 0.6**2) * 30 * stop / np.pi
    assert abs(stats["energy_supplied"] - exact) < 10 * tolerance * gross


class Released(Model):
    """A rotor on a spring with a strong damper: all of it is over in a few seconds, most in a tenth of one."""

    rotor = rotational.Inertia(J=1.0, phi=fixed(1.0), w=fixed(0.0))
    spring = rotational.SpringDamper(c=100.0, d=60.0)
    wall = rotational.Fixed()

    def connections(self):
        yield chain(self.wall.flange, self.spring, self.rotor)


@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
@pytest.mark.parametrize("intervals", [1, 40, 400, 4000])
@pytest.mark.parametrize("stop", [10.0, 20.0, 100.0, 1000.0])
def test_heat_of_a_short_part_of_a_run(stop, intervals, method):
    stats = ac.simulate(compiled(Released), stop_time=stop, intervals=intervals, method=method, energy=True).stats
    assert stats["energy_dissipated"] == pytest.approx(50.0, rel=1e-4 if method == "idas" else 1e-5)


class Positioning(Model):
    """A controlled rotor goes to three positions, each in a second: what is supplied is dissipated."""

    wall, damper = rotational.Fixed(), rotational.Damper(d=0.3)
    rotor, motor = rotational.Inertia(J=0.5, phi=fixed(0), w=fixed(0)), rotational.Torque()

    def connections(self):
        yield chain(self.wall.flange, self.damper, self.rotor)
        yield connect(self.motor.flange, self.rotor.flange_b)

    def equations(self):
        wanted = piecewise((1.0, time < 20), (2.0, time < 40), -1.0)
        gain, rate = quantity(200.0, "N.m/rad"), quantity(20.0, "N.m.s/rad")
        yield self.motor.tau == gain * (wanted - self.rotor.phi) - rate * self.rotor.w


@pytest.mark.parametrize("method", ["auto", "idas"])
@pytest.mark.parametrize("intervals", [100, 400, 2000])
def test_work_of_positioning(intervals, method):
    stats = ac.simulate(compiled(Positioning), stop_time=60.0, intervals=intervals, method=method, energy=True).stats
    root = np.sqrt(20.3**2 - 4 * 0.5 * 200)
    fast, slow = (20.3 + root) / (2 * 0.5), (20.3 - root) / (2 * 0.5)
    # w = 400 s (exp(-slow t) - exp(-fast t)) / (fast - slow)
    squares = (400 / (fast - slow)) ** 2 * (1 / (2 * slow) + 1 / (2 * fast) - 2 / (slow + fast))
    heat = 0.3 * squares * (1 + 1 + 9)
    for name in ("energy_supplied", "energy_dissipated"):
        assert stats[name] == pytest.approx(heat, rel=3e-3 if method == "idas" else 3e-5)


class Vibrating(Released):
    """The same with a weak damper, which 16 periods a second keep busy."""

    spring = rotational.SpringDamper(c=1e4, d=2.0)


@pytest.mark.parametrize("intervals", [1, 50, 500])
@pytest.mark.parametrize(("stop", "tolerance"), [(0.5, 1e-8), (1.0, 1e-6), (2.0, 1e-5), (2.0, 1e-7)])
@pytest.mark.parametrize("method", ["auto", "idas", "rosenbrock"])
def test_heat_of_a_vibration(stop, tolerance, intervals, method):
    how = {"stop_time": stop, "tolerance": tolerance, "intervals": intervals, "method": method}
    result = ac.simulate(compiled(Vibrating), energy=True, **how)
    left = result["rotor.w"][-1] ** 2 / 2 + 5e3 * result["rotor.phi"][-1] ** 2
    assert result.stats["energy_dissipated"] == pytest.approx(
        5e3 - left, rel=(1000 if method == "idas" else 10) * tolerance
    )


class Slipping(Model):
    """A clutch between two rotors breaks away at 2.25 s, where nothing else happens."""

    a = rotational.Inertia(J=1.0, phi=fixed(0.0), w=fixed(1.0))
    clutch = rotational.Clutch(f_normalized=1.0, tau_max=5.0, peak=1.2)
    b = rotational.Inertia(J=2.0, phi=fixed(0.0), w=fixed(1.0))
    load = rotational.Torque(tau=quantity(4.0, "N.m/s") * time)

    def connections(self):
        yield chain(self.load.flange, self.a, self.clutch, self.b)


@pytest.mark.parametrize("intervals", [1, 3, 13, 400])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_work_up_to_an_event_between_outputs(tolerance, intervals):
    stats = ac.simulate(
        compiled(Slipping), stop_time=3.0, tolerance=tolerance, intervals=intervals, method="idas", energy=True
    ).stats

    def power(t: float) -> float:
        return 4 * t * (1 + 2 / 3 * 2.25**2 + 2 * (t**2 - 2.25**2) - 5 * (t - 2.25))

    supplied = 2 * 2.25**2 + 2 / 3 * 2.25**4 + quad(power, 2.25, 3.0)[0]
    assert stats["energy_supplied"] == pytest.approx(supplied, rel=max(tolerance, 1e-12))
    assert abs(stats["energy_method"]) < max(tolerance, 1e-12) * supplied


class Moved(Model):
    """No states: everything is prescribed."""

    drive = rotational.Position(phi_ref=0.5 * sin(3 * time))
    spring = rotational.SpringDamper(c=10.0, d=0.3)
    ground = rotational.Fixed()

    def connections(self):
        yield connect(self.drive.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.ground.flange)


@pytest.mark.parametrize("intervals", [400, 3])
@pytest.mark.parametrize("stop", [1.0, 0.3])
def test_work_without_states(intervals, stop):
    result = ac.simulate(compiled(Moved), stop_time=stop, intervals=intervals, energy=True)
    assert result.stats["states"] == 0
    heat = 0.3 * 1.5**2 * (stop / 2 + np.sin(6 * stop) / 12)
    assert result.stats["energy_stored_change"] == pytest.approx(10 * (0.5 * np.sin(3 * stop)) ** 2 / 2)
    assert result.stats["energy_dissipated"] == pytest.approx(heat, rel=1e-6)
    assert abs(result.stats["energy_method"]) < 1e-6


class Shaken(Model):
    """No states, and many turns between two outputs."""

    drive = rotational.Position(phi_ref=0.1 * sin(50 * time) * cos(3 * time))
    spring = rotational.SpringDamper(c=10.0, d=2.0)
    ground = rotational.Fixed()

    def connections(self):
        yield connect(self.drive.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.ground.flange)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
@pytest.mark.parametrize("intervals", [1, 3, 10, 400])
def test_work_of_many_turns_between_outputs(intervals, tolerance):
    t = np.linspace(0, 3, 200001)
    w = 5 * np.cos(50 * t) * np.cos(3 * t) - 0.3 * np.sin(50 * t) * np.sin(3 * t)
    stats = ac.simulate(compiled(Shaken), stop_time=3.0, intervals=intervals, tolerance=tolerance, energy=True).stats
    heat = simpson(2 * w**2, x=t)
    assert stats["energy_dissipated"] == pytest.approx(heat, rel=tolerance)
    assert abs(stats["energy_method"]) < tolerance * heat


def along(result: ac.Result, name: str) -> np.ndarray:
    """Power or energy at the outputs."""
    return result._evaluate(result._evaluate.solver.compiled.reduced.flat.energies[name])[:, 0]


@pytest.mark.filterwarnings("ignore:.*linear frames")
@pytest.mark.parametrize("tolerance", [pytest.param(1e-4, marks=pytest.mark.slow), 1e-6])
@pytest.mark.parametrize(
    "name",
    [
        *("spin-up", "car-axis"),
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in ("governor", "squeezer", "four-bar", "four-bar-spatial")
        ),
    ],
)
def test_works_are_the_integrals_of_the_powers(name, tolerance):
    """Many outputs show the powers of the same motion, which few outputs must integrate as well."""
    cls = SCENES[name]
    stop = cls.stop_time / 2
    few = ac.simulate(compiled(cls), stop_time=stop, tolerance=tolerance, energy=True, intervals=40)
    many = ac.simulate(compiled(cls), stop_time=stop, tolerance=tolerance, energy=True, intervals=8000)
    held = np.max(np.abs(along(many, "stored_energy")))
    for power, work in (("supplied_power", "energy_supplied"), ("dissipated_power", "energy_dissipated")):
        exact = simpson(along(many, power), x=many.time)
        for result in (few, many):
            assert result.stats[work] == pytest.approx(exact, abs=30 * tolerance * held)


class Kicked(Model):
    """A rotor whose speed is set as the run starts."""

    rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(1))
    damper, wall = rotational.Damper(d=0.5), rotational.Fixed()

    def connections(self):
        yield chain(self.rotor, self.damper, self.wall.flange)

    def equations(self):
        yield when(time >= 0, reinit(self.rotor.w, 3), at_start=True)


def test_a_jump_at_the_start_is_before_the_first_point():
    result = ac.simulate(Kicked(), stop_time=1.0, tolerance=1e-8, energy=True)
    np.testing.assert_allclose(result["rotor.w"], 3 * np.exp(-0.5 * result.time), rtol=1e-6)
    lost = 4.5 * (1 - np.exp(-1))
    assert result.stats["energy_dissipated"] == pytest.approx(lost, rel=1e-6)
    assert result.stats["energy_stored_change"] == pytest.approx(-lost, rel=1e-6)
    assert result.stats["energy_supplied"] == 0


class Cancelling(Model):
    """A falling stone; powers that cancel, but for rounding."""

    h: Scalar = variable("height", start=5, fixed=True)
    v: Scalar = variable("speed", start=0, fixed=True)

    def equations(self):
        yield der(self.h) == self.v
        yield der(self.v) == -9.81

    def stored_energy(self):
        return self.v**2 / 2 + 9.81 * self.h

    def supplied_power(self):
        return exp(self.v) * exp(-self.v) - 1


def test_powers_that_cancel():
    result = ac.simulate(Cancelling(), stop_time=0.3, tolerance=1e-5, intervals=10, energy=True)
    assert abs(result.stats["energy_supplied"]) < 1e-8


def test_energy_of_an_impact_is_balanced():
    rough, fine = (
        ac.simulate(compiled(Two), stop_time=2.0, tolerance=t, energy=True).stats["energy_method"] for t in (1e-6, 1e-9)
    )
    assert abs(fine) < 1e-7
    assert abs(rough) < 1e-4


@pytest.mark.slow
def test_events_a_rounding_error_from_an_output_leave_energies_as_they_are():
    class Backlash(Model):
        """Two masses that touch in both directions."""

        p: Scalar = variable("position", start=0.3, fixed=True)
        v: Scalar = variable("its rate", fixed=True)
        q: Scalar = variable("position", fixed=True)
        w: Scalar = variable("its rate", fixed=True)

        def equations(self):
            gap, drag = self.p - self.q, 5 * (self.v - self.w)
            law = [(1e4 * (gap - side * 0.1) + drag, side * gap > 0.1) for side in (1, -1)]
            force = piecewise(*law, 0)
            yield der(self.p) == self.v
            yield der(self.q) == self.w
            yield 2 * der(self.v) == 10 * cos(3 * time) - force
            yield der(self.w) == force - 20 * self.q

        def supplied_power(self):
            return 10 * cos(3 * time) * self.v

    exact = ac.simulate(Backlash(), stop_time=3, energy=True, tolerance=1e-9).stats["energy_supplied"]
    for tolerance in (1e-7, 1e-8):
        stats = ac.simulate(Backlash(), stop_time=3, energy=True, method="idas", tolerance=tolerance).stats
        assert stats["energy_supplied"] == pytest.approx(exact, abs=1e-3)
