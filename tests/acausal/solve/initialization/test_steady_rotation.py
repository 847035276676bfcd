"""Starts in steady rotation: cyclic coordinates turn at constant rates, all else is at rest."""

from __future__ import annotations

from math import acos, pi, sqrt
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Model, chain, connect, fixed, guess, structural, time
from components import Body, FixedRotation, FlexibleBeam, Prismatic, Revolute, SpringDamperParallel, World
from components.rotational import Inertia, Position, Speed, SpringDamper, Torque

G = 9.81
LENGTH, MODULUS, DENSITY, AREA, SECOND_MOMENT = 10.0, 7e10, 2700.0, 0.04, 3.3333333e-5
SLOWEST = sqrt(MODULUS * SECOND_MOMENT / (DENSITY * AREA * LENGTH**4))


def started(model: Model, **more: Any) -> ac.Result:
    return ac.simulate(model, stop_time=0.5, intervals=5, initial="steady", tolerance=1e-9, **more)


class Blade(Model):
    """A blade that turns with a hub and flaps out of its plane."""

    world, hub = World(gravity=None), Revolute(use_axis_flange=True, phi=guess(0.3))
    drive: Component = Speed(w_ref=4 * SLOWEST)
    turned = FixedRotation(n=(1, 0, 0), angle=pi / 2)
    beam = FlexibleBeam(
        length=LENGTH, E=MODULUS, rho=DENSITY, A=AREA, J=SECOND_MOMENT, elements=8, geometric_stiffness=True
    )

    def connections(self):
        yield connect(self.drive.flange, self.hub.axis)
        yield chain(self.world, self.hub, self.turned, self.beam)


@pytest.mark.parametrize("drive", [Speed(w_ref=4 * SLOWEST), Position(phi_ref=4 * SLOWEST * time)])
def test_a_turning_blade_flaps_at_the_exact_frequency(drive):
    """A hub that turns 4 times faster than the blade's unit of frequency: 5.5850 of these (Wright and others 1982).

    In the plane of rotation the square of the frequency is less by that of the speed.
    """
    linear = ac.linearize(Blade(drive=drive), initial="steady")
    frequencies = np.sort(np.abs(np.imag(linear.eigenvalues)))
    found = np.unique(np.round(frequencies[frequencies > 1] / SLOWEST, 9))[:2]
    np.testing.assert_allclose([np.hypot(found[0], 4), found[1]], 5.5850, rtol=0, atol=2e-4)


class Flyball(Model):
    """A ball on a massless arm that swings on a vertical shaft."""

    axis: Any = structural("axis of the shaft", default=(0, 1, 0))
    swing: float = structural("guess of the arm's angle", default=-0.8)
    world, arm, ball = World(g=G, n=(0, -1, 0)), Revolute(phi=guess(swing)), Body(m=2.0, r_CM=(0.5, 0, 0))
    hub = Revolute(n=axis, phi=guess(0.3), w=fixed(5.0))

    def connections(self):
        yield chain(self.world, self.hub, self.arm, self.ball)


class DrivenFlyball(Flyball):
    hub, motor = Revolute(n=(0, 1, 0), phi=guess(0.3), use_axis_flange=True), Speed(w_ref=5.0)

    def connections(self):
        yield from super().connections()
        yield connect(self.motor.flange, self.hub.axis)


TILTED = {"axis": (0.6, 0.8, 0), "world": World(g=G, n=(-0.6, -0.8, 0)), "swing": -1.3}


@pytest.mark.parametrize(
    ("model", "beside"), [(Flyball(), 0.0), (DrivenFlyball(), 0.0), (Flyball(**TILTED), np.arctan2(0.6, 0.8))]
)
def test_a_flyball_stands_out_as_far_as_its_speed_lifts_it(model, beside):
    """From the vertical by an angle of which the cosine is g / (w^2 l); the hub is driven, or its speed is fixed."""
    run = started(model)
    np.testing.assert_allclose(run["arm.phi"], acos(G / (5.0**2 * 0.5)) - pi / 2 - beside, atol=1e-7)
    np.testing.assert_allclose(run["hub.w"], 5.0)
    np.testing.assert_allclose(run["hub.phi"][0], 0.3, atol=1e-9)


class MotorAndFan(Model):
    """A torque that falls with the speed, and a drag that rises with its square."""

    motor, rotor, fan = Torque(), Inertia(J=0.3), Torque()

    def connections(self):
        yield connect(self.motor.flange, self.rotor.flange_a)
        yield connect(self.fan.flange, self.rotor.flange_b)

    def equations(self):
        yield self.motor.tau == 2 * (1 - self.rotor.w / 10)
        yield self.fan.tau == -0.05 * self.rotor.w * abs(self.rotor.w)


class OnAShaft(MotorAndFan):
    """The same with an elastic shaft between two rotors: only the sum of their angles is cyclic."""

    shaft, far = SpringDamper(c=100.0, d=0.5), Inertia(J=0.8)

    def connections(self):
        yield connect(self.motor.flange, self.rotor.flange_a)
        yield chain(self.rotor, self.shaft, self.far, self.fan.flange)

    def equations(self):
        yield self.motor.tau == 2 * (1 - self.rotor.w / 10)
        yield self.fan.tau == -0.05 * self.far.w * abs(self.far.w)


@pytest.mark.parametrize("model", [MotorAndFan(), OnAShaft()])
def test_a_motor_and_a_fan_turn_where_their_torques_balance(model):
    speed = (-0.2 + sqrt(0.2**2 + 4 * 0.05 * 2)) / (2 * 0.05)
    run = started(model)
    np.testing.assert_allclose(run["rotor.w"], speed, rtol=1e-8)
    torque = 0.05 * speed**2
    if "far" in model.fields:
        np.testing.assert_allclose(run["far.w"], speed, rtol=1e-8)
        np.testing.assert_allclose(np.abs(run["shaft.phi_rel"]), torque / 100, rtol=1e-6)
    values = ac.linearize(model, initial="steady").eigenvalues
    if "far" not in model.fields:
        np.testing.assert_allclose(values, [0, -(0.2 + 2 * 0.05 * speed) / 0.3], atol=1e-9)


class OnASpring(Model):
    """A ball on a spring along a spoke."""

    world, hub, motor = World(gravity=None), Revolute(use_axis_flange=True, phi=guess(0.3)), Speed(w_ref=7.0)
    spoke, ball, spring = Prismatic(), Body(m=1.0, r_CM=(0.2, 0, 0)), SpringDamperParallel(c=400.0, d=1.0)

    def connections(self):
        yield connect(self.motor.flange, self.hub.axis)
        yield chain(self.world, self.hub, self.spoke, self.ball)
        yield connect(self.hub.frame_b, self.spring.frame_a)
        yield connect(self.spoke.frame_b, self.spring.frame_b)


def test_a_spring_on_a_spoke_yields_to_the_speed():
    np.testing.assert_allclose(started(OnASpring())["spoke.s"], 49 * 0.2 / (400 - 49), rtol=1e-8)


def test_weight_that_turns_round_and_drives_that_speed_up_leave_no_steady_rotation():
    with pytest.raises(ac.InitializationError, match="these rates remain"):
        started(OnASpring(world=World(g=G)))
    with pytest.raises(ac.InitializationError, match="these rates remain"):
        started(OnASpring(motor=Speed(w_ref=7.0 + 0.5 * time)))
    with pytest.raises(ac.InitializationError, match="these rates remain"):
        started(Blade(drive=Position(phi_ref=3 * time + 0.1 * time**2)))


def test_a_rest_comes_before_a_rotation():
    """The guess of a speed alone asks for none."""
    run = started(Flyball(hub=Revolute(n=(0, 1, 0), phi=guess(0.3), w=guess(5.0))))
    np.testing.assert_allclose(run["hub.w"], 0, atol=1e-9)
    np.testing.assert_allclose(run["arm.phi"], -pi / 2, atol=1e-8)
