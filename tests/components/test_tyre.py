"""Tyre: friction, creep, cornering, relaxation and contact point against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import acausal as ac
from acausal import DeclarationError, InitializationError, Model, Scalar, chain, connect, fixed, guess, parameter, part
from acausal import sin as sine
from components import (
    Body,
    FixedRotation,
    FixedTranslation,
    Planar,
    Prismatic,
    Revolute,
    Rotor1D,
    Tyre,
    World,
)
from components.rotational import Position

G, M = 9.80665, 300.0
DATA: dict[str, Any] = {"R_0": 0.3, "c_z": 2e5, "d_z": 800, "c_kappa": 6e4, "c_alpha": 5e4}
SAG: float = M * G / DATA["c_z"]


class Sled(Model):
    """A wheel that cannot turn, on the ground."""

    speed: Scalar = parameter("speed at the start", unit="m/s", default=15)
    world = World()
    along = Prismatic(n=(1, 0, 0), s=fixed(0), v=fixed(speed))
    lift = Prismatic(n=(0, 1, 0), s=guess(0.28))
    body = Body(m=M)

    @part
    def tyre(self):
        return Tyre(mu=0.7, **DATA)

    def connections(self):
        yield chain(self.world, self.along, self.lift, self.body)
        yield connect(self.body.frame_a, self.tyre.frame_a)

    def initial_equations(self):
        yield self.lift.v == 0
        yield self.lift.a == 0


def test_locked_wheel_decelerates_at_mu_g():
    result = ac.simulate(Sled(), stop_time=6, tolerance=1e-8)
    sliding = (result.time > 0.1) & (result.time < 2.1)  # it stops after 15 / (0.7 g) = 2.185 s
    np.testing.assert_allclose(result["along.a"][sliding], -0.7 * G, rtol=1e-4)
    assert result["along.s"][-1] == pytest.approx(15**2 / (2 * 0.7 * G), abs=0.03)  # a carcass may give 1 cm
    np.testing.assert_allclose(result["along.v"][-20:], 0, atol=1e-3)


def test_force_never_exceeds_friction():
    result = ac.simulate(Sled(), stop_time=3)
    force = np.hypot(result["tyre.f_x"], result["tyre.f_y"])
    assert (force <= 0.7 * result["tyre.f_z"] * (1 + 1e-9)).all()


class Parked(Sled):
    """A locked wheel on a slope of 10 %."""

    @part
    def tyre(self):
        return Tyre(height=lambda x, y: 0.1 * x, **DATA)


def test_wheel_on_a_slope_creeps_less_than_a_millimetre_in_a_second():
    """At the speed v_low f / c_kappa."""
    result = ac.simulate(Parked(speed=0), stop_time=20)
    creep = -result["along.v"][-1] * np.hypot(1, 0.1)
    pull = M * G * 0.1 / np.hypot(1, 0.1)
    assert creep < 1e-3
    assert creep == pytest.approx(0.05 * pull / DATA["c_kappa"], rel=0.02)  # slip beyond the linear range adds 0.5 %


class Car(Model):
    """A single-track vehicle with its axles 1.1 m before and 1.4 m behind the centre of mass; the front one is steered."""

    steer: Scalar = parameter("steering angle", unit="rad", default=2e-3)
    world = World()
    plane = Planar(
        n=(0, 1, 0), n_x=(1, 0, 0), s_x=fixed(0), v_x=fixed(20), s_y=fixed(0), v_y=fixed(0), phi=fixed(0), w=fixed(0)
    )
    body = Body(m=600, I=np.diag([100.0, 900.0, 900.0]))
    wheel_front, wheel_rear = Body(m=0, I=np.diag([0.0, 0.0, 0.3])), Body(m=0, I=np.diag([0.0, 0.0, 0.3]))
    to_front, to_rear = FixedTranslation(r=(1.1, 0.285, 0)), FixedTranslation(r=(-1.4, 0.285, 0))
    front, rear = Tyre(**DATA), Tyre(**DATA | {"c_alpha": 7e4})
    steering = Revolute(n=(0, 1, 0), use_axis_flange=True)
    spin_front, spin_rear = Revolute(phi=fixed(0), w=fixed(-20 / 0.285)), Revolute(phi=fixed(0), w=fixed(-20 / 0.285))

    @part
    def drive(self):
        return Position(phi_ref=self.steer)

    def connections(self):
        yield chain(self.world, self.plane, self.body)
        yield chain(self.plane, self.to_front, self.steering, self.spin_front, self.front.frame_a)
        yield chain(self.plane, self.to_rear, self.spin_rear, self.rear.frame_a)
        yield connect(self.spin_front.frame_b, self.wheel_front.frame_a)
        yield connect(self.spin_rear.frame_b, self.wheel_rear.frame_a)
        yield connect(self.drive.flange, self.steering.axis)


def test_steady_cornering_is_that_of_the_single_track_model():
    """Yaw rate v delta / (l + (m v^2 / l) (b / C_f - a / C_r)); the error of finite slip falls with the square of the angle."""
    a, b, m = 1.1, 1.4, 600.0
    errors = []
    for steer in (8e-3, 4e-3):
        result = ac.simulate(Car(steer=steer), stop_time=4, tolerance=1e-9)
        v = np.hypot(result["plane.v_x"], result["plane.v_y"])[-1]
        gradient = m / (a + b) * (b / 5e4 - a / 7e4)
        errors.append(result["plane.w"][-1] / (v * steer / (a + b + gradient * v**2)) - 1)
    assert abs(errors[1]) < 2e-3
    assert errors[1] == pytest.approx(errors[0] / 4, rel=0.2)


class Towed(Model):
    """A wheel on a heavy slide, at a small angle to its track."""

    world = World()
    turn = FixedRotation(n=(0, 1, 0), angle=-1e-3)
    slide = Prismatic(s=fixed(0), v=fixed(10))
    up = FixedTranslation(r=(0, 0.29, 0))
    back = FixedRotation(n=(0, 1, 0), angle=1e-3)
    mass = Body(m=1e9)
    spin = Revolute(phi=fixed(0), w=fixed(-10 / 0.29))
    tyre = Tyre(**DATA)
    wheel = Body(m=10, I=np.diag([0.5, 0.5, 1.0]))

    def connections(self):
        yield chain(self.world, self.turn, self.slide, self.mass)
        yield chain(self.slide, self.up, self.back, self.spin, self.wheel)
        yield connect(self.spin.frame_b, self.tyre.frame_a)


def test_lateral_force_grows_over_the_relaxation_length():
    """From a step of the slip angle: exp(-t / tau), tau = sigma / v + d / c; free rolling needs no longitudinal force."""
    result = ac.simulate(Towed(), stop_time=0.3, tolerance=1e-9)
    tau = 0.4 / 10 + 800 / 2e5
    at_once = 800 / 2e5 / tau  # share of the damper, which acts before the carcass has given way
    expected = 5e4 * 1e-3 * (1 - (1 - at_once) * np.exp(-result.time / tau))
    np.testing.assert_allclose(result["tyre.f_y"], expected, atol=1e-3 * 50)
    np.testing.assert_allclose(result["tyre.f_x"], 0, atol=1e-3 * 50)


class Rolling(Model):
    """A wheel that rolls freely over the plane."""

    world = World()
    wheel = Body(
        m=M,
        I=np.diag([12.0, 12.0, 18.0]),
        r_0=fixed((0, 0.3 - SAG, 0)),
        v_0=fixed((12, 0, 0)),
        w_a=fixed((0, 0, -12 / (0.3 - SAG))),
        angles_fixed=True,
    )
    tyre = Tyre(**DATA)

    def connections(self):
        yield connect(self.wheel.frame_a, self.tyre.frame_a)


def test_free_rolling_needs_no_force():
    result = ac.simulate(Rolling(), stop_time=2, tolerance=1e-9)
    np.testing.assert_allclose(result["wheel.v_0"][:, 0], 12, atol=1e-6)
    np.testing.assert_allclose(result["tyre.f_x"], 0, atol=1e-3)
    np.testing.assert_allclose(result["tyre.f_z"], M * G, rtol=1e-6)


class Wavy(Rolling):
    """The same over waves."""

    @part
    def tyre(self):
        return Tyre(height=lambda x, y: 0.03 * sine(3 * x + 1 * y), **DATA)


def test_contact_point_is_nearest_to_the_centre():
    """Of the points of the ground in the plane of the wheel; the force is normal to the ground there."""
    result = ac.simulate(Wavy(), stop_time=0.4, intervals=8)
    for k in range(9):
        r, n = result["wheel.r_0"][k], result["wheel.frame_a.R.T"][k][2]

        def point(x, r=r, n=n):
            """Point of the ground at x in the plane of the wheel; y is along -z."""
            z = r[2]
            for _ in range(50):
                h = 0.03 * np.sin(3 * x - z)
                z = r[2] - (n[0] * (x - r[0]) + n[1] * (h - r[1])) / n[2]
            return np.array([x, 0.03 * np.sin(3 * x - z), z])

        found = minimize_scalar(
            lambda x, r=r: np.sum((point(x) - r) ** 2), bounds=(r[0] - 0.2, r[0] + 0.2), options={"xatol": 1e-10}
        )
        np.testing.assert_allclose(r + result["tyre.arm"][k], point(found.x), atol=1e-6)
        assert result["tyre.radius"][k] == pytest.approx(np.sqrt(found.fun), abs=1e-9)


class Inclined(Rolling):
    """A wheel inclined and turning on waves."""

    wheel = Body(
        m=M,
        I=np.diag([12.0, 12.0, 18.0]),
        r_0=fixed((0, 0.29, 0)),
        v_0=fixed((5, 0, 0.5)),
        w_a=fixed((0.2, 0.5, -12)),
        angles_start=(0.1, 0.2, 0),
        angles_fixed=True,
    )
    tyre = Tyre(height=lambda x, y: 0.02 * sine(3 * x + 1 * y), **DATA)


class OnShaft(Inclined):
    """The same wheel as a rotor on a housing that does not turn with it."""

    wheel = Body(
        m=M,
        I=np.diag([12.0, 12.0, 19.0]),
        r_0=fixed((0, 0.29, 0)),
        v_0=fixed((5, 0, 0.5)),
        w_a=fixed((0.2, 0.5, 0)),
        angles_start=(0.1, 0.2, 0),
        angles_fixed=True,
    )
    rotor = Rotor1D(J=18, n=(0, 0, 1), phi=fixed(0), w=fixed(-12))
    tyre = Tyre(use_axis_flange=True, height=lambda x, y: 0.02 * sine(3 * x + 1 * y), **DATA)

    def connections(self):
        yield from super().connections()
        yield connect(self.wheel.frame_a, self.rotor.frame_a)
        yield connect(self.rotor.flange_b, self.tyre.axis)


def test_wheel_on_a_shaft_moves_like_one_that_turns_with_its_frame():
    one, other = (ac.simulate(model(), stop_time=0.6, tolerance=1e-8, energy=True) for model in (Inclined, OnShaft))
    np.testing.assert_allclose(other["wheel.r_0"], one["wheel.r_0"], atol=1e-6)
    assert np.ptp(one["wheel.v_0"], axis=0).min() > 0.1
    for result in (one, other):
        assert abs(result.stats["energy_method"]) < 1e-5 * result.stats["energy_dissipated"]


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"n": (0, 0, 0)}, "`n` has length 0"),
        ({"n_x": (0, 2, 0)}, "`n_x` is parallel to `up`"),
        ({"c_z": -1}, "greater than 0"),
        ({"height": 0.1}, "height"),
    ],
)
def test_wrong_input(values, message):
    with pytest.raises(DeclarationError, match=message):
        ac.compile(Rolling(tyre=Tyre(**DATA | values)))


START = {"r_0": fixed((0, 0.3, 0)), "v_0": fixed((0, 0, 0)), "w_a": fixed((0, 0, 0)), "angles_fixed": True}


@pytest.mark.parametrize(
    ("start", "message"),
    [({"r_0": fixed((0, -0.1, 0))}, "below the ground"), ({"angles_start": (1.3, 0, 0)}, "more than 60 degrees")],
)
def test_wrong_start(start, message):
    wheel = Body(m=M, I=np.diag([12.0, 12.0, 18.0]), **START | start)
    with pytest.raises(InitializationError, match=message):
        ac.simulate(Rolling(wheel=wheel), stop_time=0.1)
