"""Inputs of the whole model have no derivatives; filtered inputs have."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, Scalar, chain, connect, der, fixed, input, output, variable
from components import Body, BodyRod, Fixed, Revolute, World, rotational
from components.rotational.position import AF, BF


class Turned(Model):
    u: Scalar = input("angle", unit="rad")
    y: Scalar = output("angle of the load", unit="rad")
    drive, load = rotational.Position(phi_ref=u), rotational.Inertia(J=1)

    def connections(self):
        yield connect(self.drive.flange, self.load.flange_a)

    def equations(self):
        yield self.y == self.load.phi


class Spun(Turned):
    u: Scalar = input("speed", unit="rad/s")
    drive = rotational.Speed(w_ref=u)


class Arm(Model):
    """A drive on a joint of a body."""

    u: Scalar = input("angle", unit="rad")
    world, joint, rod = World(g=9.81), Revolute(use_axis_flange=True), Body(m=1, r_CM=(1, 0, 0))
    drive = rotational.Position(phi_ref=2 * u)

    def connections(self):
        yield chain(self.world, self.joint, self.rod)
        yield connect(self.joint.axis, self.drive.flange)


class Loop(Model):
    """The same in a parallelogram."""

    u: Scalar = input("angle", unit="rad")
    world, far = World(g=9.81), Fixed(r=(2, 0, 0))
    crank, rocker, coupler = BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(1, 0, 0), m=1), BodyRod(r=(2, 0, 0), m=2)
    pin1, pin2, foot1, foot2 = Revolute(), Revolute(), Revolute(use_axis_flange=True), Revolute()
    drive = rotational.Position(phi_ref=u)

    def connections(self):
        yield chain(self.world, self.foot1, self.crank, self.pin1, self.coupler, self.pin2, self.rocker.frame_b)
        yield chain(self.far, self.foot2, self.rocker)
        yield connect(self.foot1.axis, self.drive.flange)


@pytest.mark.parametrize("model", [Turned, Spun, Arm, Loop])
def test_an_input_that_would_be_differentiated_is_refused(model: type[Model]) -> None:
    with pytest.raises(ac.DeclarationError, match=r"drive \((Position|Speed)\).*\.py:\d+.*input `u`.*exact=False"):
        ac.compile(model())


def test_der_of_an_input_is_refused() -> None:
    class Rate(Model):
        u: Scalar = input("signal")
        y: Scalar = variable("its rate")

        def equations(self):
            yield self.y == der(self.u**2)

    with pytest.raises(ac.DeclarationError, match=r"der\(\) is applied.*input `u`"):
        ac.compile(Rate())


def test_inputs_that_need_no_derivative_are_taken() -> None:
    class Pushed(Model):
        u: Scalar = input("torque", unit="N.m")
        drive, load = rotational.Torque(tau=u), rotational.Inertia(J=2, phi=fixed(0), w=fixed(0))

        def connections(self):
            yield connect(self.drive.flange, self.load.flange_a)

    result = ac.simulate(Pushed(u=4), stop_time=1)
    assert result["load.phi"][-1] == pytest.approx(1, rel=1e-5)


class FilteredAngle(Turned):
    drive = rotational.Position(phi_ref=Turned.u, exact=False, f_crit=2)


class FilteredSpeed(Spun):
    drive = rotational.Speed(w_ref=Spun.u, exact=False, f_crit=2, phi=fixed(0))


def test_filters_follow_an_input() -> None:
    assert np.allclose(ac.simulate(FilteredAngle(u=0.7), stop_time=1)["y"], 0.7)
    assert ac.simulate(FilteredSpeed(u=0.7), stop_time=1)["y"][-1] == pytest.approx(0.7)


def test_the_filter_of_an_angle_against_its_equation() -> None:
    """A ramp, with what the load needs of torque."""

    class Ramp(Model):
        drive: Any = rotational.Position(phi_ref=ac.time, exact=False, f_crit=2)
        load = rotational.Inertia(J=3)

        def connections(self):
            yield connect(self.drive.flange, self.load.flange_a)

    crit = 4 * np.pi
    result = ac.simulate(Ramp(), stop_time=1, tolerance=1e-9)
    exact = solve_ivp(
        lambda t, y: [y[1], ((t - y[0]) * crit - AF * y[1]) * crit / BF],
        (0, 1),
        [0, 0],
        "DOP853",
        result.time,
        rtol=1e-11,
        atol=1e-12,
    )
    assert np.allclose(result["load.phi"], exact.y[0], atol=1e-6)
    assert np.allclose(result["drive.flange.tau"], -3 * result["load.a"], atol=1e-8)


def test_the_critical_frequency_is_where_the_gain_falls_to_half_the_power() -> None:
    linear = ac.linearize(FilteredAngle(u=0.0))
    s = 2j * np.pi * 2
    gain = linear.C @ np.linalg.solve(s * np.eye(len(linear.A)) - linear.A, linear.B) + linear.D
    assert abs(gain[0, 0]) == pytest.approx(np.sqrt(0.5), rel=2e-3)
    assert np.real(linear.eigenvalues).max() < -1
