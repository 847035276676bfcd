"""Coulomb friction in the joints of closed loops: it sticks where it can, and changes its sign where the rest moves on."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import acausal as ac
from acausal import AcausalWarning, Model, chain, connect, cos, fixed, guess, piecewise, sin, time
from components import Revolute, rotational
from tests.acausal.solve.events.cranks import (
    CRANK,
    G,
    Parallelogram,
    SliderCrank,
    by_hand,
    friction,
    joint,
    parallelogram_by_hand,
    rates_of_joints,
    slider_crank,
)
from tests.benchmarks.events.scenes import StickSlip

slow = pytest.mark.slow
METHODS = ("auto", pytest.param("idas", marks=slow))
# tau, speed, gravity, output range over which it is compared
REVERSING = [
    ({3: 0.01}, 20.0, 0.0, 1.0),
    ({3: 1.0}, 1.0, G, 1.0),
    ({2: 1.0, 3: 50.0}, 20.0, G, 1.0),
    *(
        pytest.param(*case, marks=slow)
        for case in (
            ({3: 0.001}, 1.0, 0.0, 1.0),
            ({3: 50.0}, 1.0, G, 1.0),
            ({1: 1.0, 2: 1.0, 3: 1.0}, 20.0, G, 1.0),
            ({1: 1.0, 2: 1.0, 3: 1.0, 4: 5.0}, 20.0, 0.0, 1.0),
            ({3: 0.01}, 200.0, 0.0, 0.2),
            ({3: 50.0}, 200.0, 0.0, 0.2),
        )
    ),
]


@pytest.mark.filterwarnings("ignore:more joints stick:acausal.AcausalWarning")
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("tau", "w", "g", "stop"), REVERSING)
def test_an_engine_with_friction_in_its_joints(tau, w, g, stop, method):
    run = ac.simulate(
        slider_crank(w=w, g=g), stop_time=stop, tolerance=1e-6, method=method, parameters=friction(tau), energy=True
    )
    phi, speed, lost = by_hand(stop, 1.0, w, tau, g)
    leeway = 1e-5 if method == "auto" else 1e-4
    assert run["j1.phi"][-1] == pytest.approx(phi, abs=leeway * max(1, w))
    assert run["j1.w"][-1] == pytest.approx(speed, abs=10 * leeway * max(1, w))
    assert run.stats["energy_dissipated"] == pytest.approx(lost, rel=2e-5, abs=1e-6 if tau != {3: 50.0} else 1e-4)


@pytest.mark.filterwarnings("ignore:more joints stick:acausal.AcausalWarning")
@pytest.mark.parametrize("phi", [np.pi / 2, pytest.param(-np.pi / 2, marks=slow), pytest.param(0.0, marks=slow)])
@pytest.mark.parametrize(("tau", "w"), [({3: 2.0}, 20.0), ({1: 0.5, 2: 1.0, 3: 2.0}, 0.0), ({4: 5.0, 2: 0.1}, 0.0)])
def test_starts_in_dead_centres(phi, w, tau):
    """At 90 degrees the rod reverses, at 0 degrees the piston does."""
    run = ac.simulate(slider_crank(phi, w, G), stop_time=0.3, tolerance=1e-7, parameters=friction(tau))
    expected = by_hand(0.3, phi, w, tau, G)
    assert run["j1.phi"][-1] == pytest.approx(expected[0], abs=1e-5)
    assert run["j1.w"][-1] == pytest.approx(expected[1], abs=1e-4)


PRESCRIBED = {
    "swings": (rotational.Position(phi_ref=1 + 2 * sin(3 * time)), lambda t: 1 + 2 * np.sin(3 * t)),
    "turns": (rotational.Position(phi_ref=1 + 20 * time), lambda t: 1 + 20 * t),
    "speed": (rotational.Speed(w_ref=6 * cos(3 * time), phi=fixed(1.0)), lambda t: 1 + 2 * np.sin(3 * t)),
    "rests": (
        rotational.Position(phi_ref=piecewise((1 + (1 - time) ** 3, time < 1), (1, time < 1.5), 1 - (time - 1.5) ** 3)),
        lambda t: np.where(t < 1, 1 + (1 - t) ** 3, np.where(t < 1.5, 1, 1 - np.maximum(t - 1.5, 0) ** 3)),
    ),
    "starts in a dead centre": (rotational.Position(phi_ref=np.pi / 2 + time**2), lambda t: np.pi / 2 + t**2),
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "how", ["swings", "rests", *(pytest.param(k, marks=slow) for k in PRESCRIBED if k not in ("swings", "rests"))]
)
def test_nothing_sticks_where_a_drive_prescribes_the_motion(how, method):
    """What friction takes is the torque of each joint times the angle that it passes."""
    drive, angle = PRESCRIBED[how]
    tau, phi = {1: 1.0, 2: 2.0, 3: 3.0}, angle(np.linspace(0, 2.5, 500_001))

    class Prescribed(SliderCrank):
        source = drive

        def connections(self):
            yield from super().connections()
            yield connect(self.source.flange, self.j1.axis)

    model = slider_crank(float(phi[0]), None, G, Prescribed)
    run = ac.simulate(model, stop_time=2.5, method=method, tolerance=1e-6, parameters=friction(tau), energy=True)
    np.testing.assert_allclose(run["j1.phi"], angle(run.time), atol=1e-4)
    J = rates_of_joints(phi[:-1])
    lost = sum(t * np.sum(np.abs(J[k] * np.diff(phi))) for k, t in tau.items())
    assert run.stats["energy_dissipated"] == pytest.approx(lost, rel=2e-5)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("tau", [0.001, 0.5, 5.0])
def test_a_parallelogram_with_friction_in_four_pins(tau, method):
    """All pins reverse at one instant, and where they hold they share the load evenly; one warning names them."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        parameters = {f"f{k}.tau_sliding": tau for k in "abcd"}
        run = ac.simulate(
            Parallelogram(), stop_time=3.0, method=method, tolerance=1e-7, parameters=parameters, energy=True
        )
    phi, w, lost = parallelogram_by_hand(3.0, -1.0, tau)
    assert run["a.phi"][-1] == pytest.approx(phi, abs=1e-4 if method == "idas" else 5e-6)
    assert run["a.w"][-1] == pytest.approx(w, abs=1e-3 if method == "idas" else 2e-5)
    assert run.stats["energy_dissipated"] == pytest.approx(lost, rel=1e-4, abs=1e-5)
    held = np.array([run[f"f{k}.mode"][-1] for k in "abcd"]) == 0
    assert held.all() or not held.any()
    told = [str(w.message) for w in caught if issubclass(w.category, AcausalWarning)]
    assert len(told) == held.all()
    if held.all():
        assert told[0].count("`") == 6  # three of the four are redundant
        shared = np.array([run[f"f{k}.tau"][-1] for k in "abcd"]) * (1, 1, -1, 1)
        np.testing.assert_allclose(shared, -1.5 * G * np.cos(run["a.phi"][-1]) / 4, rtol=1e-6)


@pytest.mark.filterwarnings("ignore:more joints stick:acausal.AcausalWarning")
@pytest.mark.parametrize("peak", [1.0, 1.5])
def test_redundant_friction_breaks_away_where_all_of_it_is_spent(peak):
    down = -np.pi / 2
    model = Parallelogram(
        push=rotational.Torque(tau=4 * time),
        a=Revolute(phi=fixed(down), w=fixed(0), use_axis_flange=True),
        b=joint(guess(down)),
        c=joint(guess(-down)),
        d=joint(guess(down)),
    )
    static = {f"f{k}.tau_static": 0.5 * peak for k in "abcd"}
    run = ac.simulate(model, stop_time=1.0, tolerance=1e-7, parameters=static)
    leaves = np.abs(run["a.w"]) > 1e-6
    assert run.stats["event_times"][3] == pytest.approx(0.5 * peak, abs=1e-6)
    assert run.time[leaves][0] == pytest.approx(0.5 * peak, abs=0.01)
    if peak == 1:
        phi, w, _ = parallelogram_by_hand(1.0, down, 0.5, lambda t: 4 * t)
        assert (run["a.phi"][-1], run["a.w"][-1]) == pytest.approx((phi, w), abs=2e-5)


@pytest.mark.filterwarnings("ignore:more joints stick:acausal.AcausalWarning")
def test_a_joint_that_static_friction_holds_where_that_of_sliding_would_not():
    """It comes to rest where the weight is more than friction of sliding, and less than static friction."""
    tau = {1: 2.0, 2: 1.0, 3: 3.0}
    held = ac.simulate(slider_crank(w=1.0, g=G), stop_time=1.0, parameters=friction(tau, peak=1.5))
    assert abs(held["j1.w"][-1]) < 1e-8
    phi = held["j1.phi"][-1]
    J = rates_of_joints(phi)
    weight = G * CRANK * (5 / 2 + 1 / 2) * abs(np.cos(phi))
    spent = sum(abs(J[k]) * t for k, t in tau.items())
    assert spent < weight < 1.5 * spent
    moved = by_hand(1.0, 1.0, 1.0, tau, G)
    assert abs(moved[0] - phi) > 1


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("tau", "sticks"), [(0.1, False), (1.0, True)])
def test_slide_and_joints_that_reverse_at_one_instant(tau, sticks, method):
    """The crank swings below its bearing: where it turns round, everything does."""
    every = dict.fromkeys((1, 2, 3, 4), tau)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        run = ac.simulate(
            slider_crank(-1.0, 0.0, G),
            stop_time=2.0,
            method=method,
            tolerance=1e-7,
            parameters=friction(every),
            energy=True,
        )
    phi, w, lost = by_hand(2.0, -1.0, 0.0, every, G)
    assert run["j1.phi"][-1] == pytest.approx(phi, abs=1e-4 if method == "idas" else 5e-6)
    assert run["j1.w"][-1] == pytest.approx(w, abs=1e-3 if method == "idas" else 2e-5)
    assert run.stats["energy_dissipated"] == pytest.approx(lost, rel=1e-4)
    assert any("is redundant" in str(one.message) for one in caught) == sticks


class Braked(Model):
    drive = rotational.Torque(tau=time)
    rotor = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))
    one, other = rotational.Friction(tau_sliding=1.0, tau_static=1.2), rotational.Friction(tau_sliding=2.0)
    wall = rotational.Fixed()

    def connections(self):
        yield chain(self.drive, self.rotor, self.one, self.wall.flange)
        yield chain(self.rotor, self.other, self.wall.flange)


def test_two_brakes_on_one_shaft():
    with pytest.warns(AcausalWarning, match=r"the friction of `(one|other)` is redundant"):
        run = ac.simulate(Braked(), stop_time=5.0)
    assert run.stats["event_times"][-1] == pytest.approx(3.2, abs=1e-6)
    assert run["rotor.w"][-1] == pytest.approx((25 - 3.2**2) / 2 - 3 * 1.8, abs=1e-6)


def test_a_clutch_that_closes_at_rest():
    class Idle(Model):
        drive = rotational.Torque(tau=piecewise((0, time < 2), 1))
        a = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))
        clutch = rotational.Clutch(tau_max=5.0, f_normalized=piecewise((0, time < 1), 1))
        b = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0))

        def connections(self):
            yield chain(self.drive, self.a, self.clutch, self.b)

    run = ac.simulate(Idle(), stop_time=4.0)
    assert (run["a.w"][-1], run["b.w"][-1]) == pytest.approx((1, 1), abs=1e-4)


def test_guesses_at_which_a_loop_is_half_a_turn_apart():
    """Its closure has no value there: it was a bare ValueError."""
    model = Parallelogram(c=joint(guess(1.0)), d=joint(guess(np.pi - 1.0)))
    assert np.exp(1j * ac.simulate(model, stop_time=0.5)["d.phi"][0]) == pytest.approx(np.exp(-1j), abs=1e-6)


def test_a_start_at_rest_under_a_load():
    """A wheel on a belt sticks from the start on, until the spring tears it off."""
    run = ac.simulate(StickSlip(), stop_time=0.19, tolerance=1e-8)
    np.testing.assert_allclose(run["angle"], 0.4 + run.time, atol=1e-9)
    np.testing.assert_allclose(run["contact.mode"], 0)
