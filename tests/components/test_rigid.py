"""Rigid bodies, joints, springs and drives against solutions that use none of this code (tests/reference)."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Model, chain, connect, fixed, sin, structural, time
from components import (
    Body,
    BodyShape,
    Damper,
    FixedRotation,
    FixedTranslation,
    Prismatic,
    Revolute,
    Spherical,
    Spring,
    SpringDamperParallel,
    World,
    WorldForce,
)
from components import rotational as rot
from tests.reference import central_gravity, double_pendulum, free_body, oscillators

TOLERANCE = 1e-9
G = 9.81


def rod(mass, length, **starts):
    inertia = mass * length**2 / 12
    return BodyShape(r=(length, 0, 0), m=mass, r_CM=(length / 2, 0, 0), I=np.diag([0, inertia, inertia]), **starts)


class DoublePendulum(Model):
    world = World(g=G)
    first = Revolute(phi=fixed(0.3), w=fixed(0.0))
    upper = rod(2.0, 0.8)
    second = Revolute(phi=fixed(-0.9), w=fixed(1.5))
    lower = rod(1.0, 0.5)

    def connections(self):
        yield chain(self.world, self.first, self.upper, self.second, self.lower)


class TurnedRoundDoublePendulum(DoublePendulum):
    """The joints and the upper rod connected the other way."""

    first = Revolute(phi=fixed(-0.3), w=fixed(0.0))
    second = Revolute(phi=fixed(0.9), w=fixed(-1.5))
    upper = BodyShape(r=(-0.8, 0, 0), m=2.0, r_CM=(-0.4, 0, 0), I=np.diag([0, 2 * 0.8**2 / 12, 2 * 0.8**2 / 12]))

    def connections(self):
        yield connect(self.world.frame_b, self.first.frame_b)
        yield connect(self.first.frame_a, self.upper.frame_b)
        yield connect(self.upper.frame_a, self.second.frame_b)
        yield connect(self.second.frame_a, self.lower.frame_a)


@pytest.mark.parametrize("model", [DoublePendulum, TurnedRoundDoublePendulum])
def test_double_pendulum(model):
    result = ac.simulate(model(), stop_time=2.0, tolerance=TOLERANCE, intervals=40)
    rods = double_pendulum.Rod.uniform(2.0, 0.8), double_pendulum.Rod.uniform(1.0, 0.5)
    states = double_pendulum.simulate(*rods, [0.3, -0.6], [0.0, 1.5], result.time, G)
    elbow, tip = double_pendulum.ends(*rods, states)
    np.testing.assert_allclose(result["second.frame_a.r_0"][:, :2], elbow, atol=1e-5)
    np.testing.assert_allclose(result["lower.frame_b.r_0"][:, :2], tip, atol=1e-5)
    np.testing.assert_allclose(result["lower.w_a"][:, 2], states[:, 3], atol=1e-4)


class TorqueFree(Model):
    world = World(gravity=None)
    body = Body(
        m=3.0,
        r_CM=(0.1, -0.2, 0.3),
        I=np.diag([1.0, 2.0, 3.0]),
        v_0=fixed((0.1, -0.2, 0.3)),
        r_0=fixed((1, 2, 3)),
        w_a=fixed((1.0, 0.0, 1.2)),
        angles_fixed=True,
        angles_start=(0.4, -0.5, 0.6),
    )


def test_torque_free_body():
    result = ac.simulate(TorqueFree(), stop_time=10.0, tolerance=TOLERANCE, intervals=50)
    rate = free_body.torque_free_rate([1, 2, 3], 1.0, 1.2, result.time)
    np.testing.assert_allclose(result["body.w_a"], rate, atol=1e-5)
    T = result["body.frame_a.R.T"]
    centre = result["body.r_0"] + np.einsum("tji,j->ti", T, [0.1, -0.2, 0.3])
    velocity = np.diff(centre, axis=0) / np.diff(result.time)[:, None]
    np.testing.assert_allclose(velocity, np.tile(velocity[0], (50, 1)), atol=1e-5)
    momentum = np.einsum("tji,tj->ti", T, result["body.w_a"] * [1, 2, 3])
    np.testing.assert_allclose(momentum, np.tile(momentum[0], (51, 1)), atol=1e-5)
    np.testing.assert_allclose(np.sum(result["body.frame_a.Q"] ** 2, axis=1), 1.0, atol=1e-7)


THETA, SPIN, ARM, MASS = 0.5, 80.0, 0.3, 1.5
TRANSVERSE_CM, AXIAL = 0.02, 0.03


class HeavyTop(Model):
    """Top about a spherical joint; its axis of symmetry is y of the body."""

    world = World(g=G)
    joint = Spherical(sequence_start=(3, 1, 2), angles_start=(-THETA, 0, 0), angles_fixed=True)
    body = Body(m=MASS, r_CM=(0, ARM, 0), I=np.diag([TRANSVERSE_CM, AXIAL, TRANSVERSE_CM]), w_a=fixed((0, SPIN, 0)))

    def connections(self):
        yield chain(self.world, self.joint, self.body)


class TurnedRoundHeavyTop(HeavyTop):
    joint = Spherical(sequence_start=(3, 1, 2), angles_start=(THETA, 0, 0), angles_fixed=True)

    def connections(self):
        yield connect(self.world.frame_b, self.joint.frame_b)
        yield connect(self.joint.frame_a, self.body.frame_a)


class GimballedTop(Model):
    """The same top on three revolute joints: precession, inclination, own rotation."""

    world = World(g=G)
    precession = Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(0))
    inclination = Revolute(n=(0, 0, -1), phi=fixed(THETA), w=fixed(0))
    rotation = Revolute(n=(0, 1, 0), phi=fixed(0), w=fixed(SPIN))
    body = Body(m=MASS, r_CM=(0, ARM, 0), I=np.diag([TRANSVERSE_CM, AXIAL, TRANSVERSE_CM]))

    def connections(self):
        yield chain(self.world, self.precession, self.inclination, self.rotation, self.body)


@pytest.mark.parametrize("model", [HeavyTop, TurnedRoundHeavyTop, GimballedTop])
def test_heavy_top(model):
    result = ac.simulate(model(), stop_time=1.5, tolerance=1e-10, intervals=60)
    transverse = TRANSVERSE_CM + MASS * ARM**2
    top = free_body.heavy_top(transverse, AXIAL, MASS * G * ARM, [THETA, 0, 0], SPIN, result.time)
    axis = result["body.frame_a.R.T"][:, 1, :]
    np.testing.assert_allclose(axis, free_body.top_axis(top[:, 0], top[:, 1]), atol=5e-6)
    np.testing.assert_allclose(result["body.w_a"][:, 1], SPIN, rtol=2e-6)


class SteadyTop(HeavyTop):
    """Slow steady precession: the inclination stays."""

    rate = free_body.steady_precession(TRANSVERSE_CM + MASS * ARM**2, AXIAL, MASS * G * ARM, THETA, SPIN)[0]
    joint = Spherical(
        sequence_start=(3, 1, 2),
        angles_start=(-THETA, 0, 0),
        angles_fixed=True,
        w_rel_a=fixed(
            tuple(np.array([0, rate, 0]) + (SPIN - rate * np.cos(THETA)) * np.array([np.sin(THETA), np.cos(THETA), 0]))
        ),
    )
    body = Body(m=MASS, r_CM=(0, ARM, 0), I=np.diag([TRANSVERSE_CM, AXIAL, TRANSVERSE_CM]))


def test_steady_precession():
    result = ac.simulate(SteadyTop(), stop_time=2.0, tolerance=TOLERANCE, intervals=40)
    axis = result["body.frame_a.R.T"][:, 1, :]
    np.testing.assert_allclose(axis, free_body.top_axis(np.full(41, THETA), SteadyTop.rate * result.time), atol=2e-5)


class Orbit(Model):
    world = World(gravity="point", mu=3.986004418e14)
    body = Body(
        m=100.0,
        I=np.eye(3),
        r_0=fixed((7e6, 1e5, -2e5)),
        v_0=fixed((-500.0, 6000.0, 5200.0)),
        w_a=fixed((0, 0, 1e-3)),
        angles_fixed=True,
    )


def test_kepler_orbit():
    result = ac.simulate(Orbit(), stop_time=6000.0, tolerance=TOLERANCE, intervals=60)
    position, velocity = central_gravity.orbit((7e6, 1e5, -2e5), (-500.0, 6000.0, 5200.0), 3.986004418e14, result.time)
    np.testing.assert_allclose(result["body.r_0"], position, atol=7e6 * 2e-6)
    np.testing.assert_allclose(result["body.v_0"], velocity, atol=8e3 * 2e-6)


class SpringMass(Model):
    world = World(gravity=None)
    slide = Prismatic(n=(1, 2, 2), s=fixed(1.2), v=fixed(-0.3))
    body = Body(m=2.0)
    spring = SpringDamperParallel(c=50.0, d=1.5, s_unstretched=1.0)
    push = WorldForce(force=(1.0, 2.0, 2.0))

    def connections(self):
        yield chain(self.world, self.slide, self.body)
        yield chain(self.world, self.spring, self.body)
        yield chain(self.push, self.body)


class SeparateSpringAndDamper(SpringMass):
    spring = Spring(c=50.0, s_unstretched=1.0)
    damper = Damper(d=1.5)

    def connections(self):
        yield super().connections()
        yield connect(self.body.frame_a, self.damper.frame_a)
        yield connect(self.damper.frame_b, self.world.frame_b)


@pytest.mark.parametrize("model", [SpringMass, SeparateSpringAndDamper])
def test_spring_mass_damper(model):
    result = ac.simulate(model(), stop_time=3.0, tolerance=TOLERANCE, intervals=60, energy=True)
    x, v = oscillators.spring_mass_damper(result.time, 2.0, 50.0, 1.5, 0.2, -0.3, 3.0)
    np.testing.assert_allclose(result["slide.s"], 1.0 + x, atol=1e-6)
    np.testing.assert_allclose(result["slide.v"], v, atol=1e-5)
    np.testing.assert_allclose(result["spring.v"], v, atol=1e-5)
    stats = result.stats
    assert stats["energy_dissipated"] > 0.1
    assert abs(stats["energy_method"]) < 1e-5


class TorsionalChain(Model):
    wall = rot.Fixed(phi0=0.0)
    spring_0 = rot.SpringDamper(c=30.0, d=0.2)
    rotor_1 = rot.Inertia(J=1.0, phi=fixed(0.1), w=fixed(0.0))
    spring_1 = rot.Spring(c=20.0)
    damper_1 = rot.Damper(d=0.1)
    rotor_2 = rot.Inertia(J=0.5, phi=fixed(-0.2), w=fixed(1.0))
    spring_2 = rot.SpringDamper(c=10.0, d=0.0)
    rotor_3 = rot.Inertia(J=2.0, phi=fixed(0.0), w=fixed(0.0))
    drive = rot.Torque(tau=0.7)

    def connections(self):
        yield chain(self.wall, self.spring_0, self.rotor_1, self.spring_1, self.rotor_2, self.spring_2, self.rotor_3)
        yield chain(self.rotor_1, self.damper_1, self.rotor_2)
        yield connect(self.rotor_3.flange_b, self.drive.flange)


def test_torsional_chain():
    result = ac.simulate(TorsionalChain(), stop_time=3.0, tolerance=TOLERANCE, intervals=60, energy=True)
    phi, w = oscillators.chain_response(
        result.time, [1, 0.5, 2], [30, 20, 10, 0], [0.2, 0.1, 0, 0], [0.1, -0.2, 0], [0, 1, 0], [0, 0, 0.7]
    )
    for k in range(3):
        np.testing.assert_allclose(result[f"rotor_{k + 1}.phi"], phi[:, k], atol=1e-6)
        np.testing.assert_allclose(result[f"rotor_{k + 1}.w"], w[:, k], atol=1e-5)
    assert abs(result.stats["energy_supplied"] - 0.7 * phi[-1, 2]) < 1e-5
    assert abs(result.stats["energy_method"]) < 1e-5


class DrivenPendulum(Model):
    """A pendulum on a driven shaft: the drive bears the weight and the inertia."""

    world = World(g=G)
    joint = Revolute(use_axis_flange=True)
    arm = rod(2.0, 0.8)
    second = Revolute(phi=fixed(0.0), w=fixed(0.0))
    lower = rod(1.0, 0.5)
    drive = rot.Position(phi_ref=0.5 * sin(2.0 * time))

    def connections(self):
        yield chain(self.world, self.joint, self.arm, self.second, self.lower)
        yield connect(self.joint.axis, self.drive.flange)


def test_prescribed_angle_and_power():
    result = ac.simulate(DrivenPendulum(), stop_time=2.0, tolerance=TOLERANCE, intervals=40, energy=True)
    np.testing.assert_allclose(result["joint.phi"], 0.5 * np.sin(2 * result.time), atol=1e-12)
    np.testing.assert_allclose(result["joint.w"], np.cos(2 * result.time), atol=1e-12)
    np.testing.assert_allclose(result["joint.a"], -2 * np.sin(2 * result.time), atol=1e-12)
    assert abs(result.stats["energy_supplied"]) > 0.1
    assert abs(result.stats["energy_method"]) < 1e-5


class SpeedDrive(Model):
    drive = rot.Speed(w_ref=3.0 * time, phi=fixed(0.5))
    rotor = rot.Inertia(J=2.0)

    def connections(self):
        yield chain(self.drive, self.rotor)


def test_prescribed_speed():
    result = ac.simulate(SpeedDrive(), stop_time=2.0, tolerance=TOLERANCE, intervals=20, energy=True)
    np.testing.assert_allclose(result["rotor.phi"], 0.5 + 1.5 * result.time**2, atol=1e-6)
    np.testing.assert_allclose(result["drive.flange.tau"], -6.0, atol=1e-9)
    assert result.stats["energy_supplied"] == pytest.approx(36.0, abs=1e-5)


class TurnedScene(Model):
    """A double pendulum in space; the whole scene may be turned and shifted together with gravity."""

    angle: float = structural("turn of the scene", default=0.0)
    n = structural("axis of the turn", default=(1, 0, 0), shape=(3,))
    down = structural("direction of gravity", default=(0, -1, 0), shape=(3,))
    world = World(g=G, n=down)
    shift = FixedTranslation(r=(0, 0, 0))
    place = FixedRotation(n=n, angle=angle)
    joint = Spherical(w_rel_a=fixed((1.0, 2.0, 0.5)), angles_fixed=True)
    upper = rod(2.0, 0.8)
    hinge = Revolute(n=(0, 1, 1), phi=fixed(0.4), w=fixed(0.0))
    lower = rod(1.0, 0.5)

    def connections(self):
        yield chain(self.world, self.shift, self.place, self.joint, self.upper, self.hinge, self.lower)


def test_frame_invariance():
    from scipy.spatial.transform import Rotation

    n = np.array([1.0, -2.0, 0.5]) / np.linalg.norm([1.0, -2.0, 0.5])
    turn = Rotation.from_rotvec(0.9 * n)
    plain = ac.simulate(TurnedScene(), stop_time=1.0, tolerance=TOLERANCE, intervals=20)
    turned = ac.simulate(
        TurnedScene(angle=0.9, n=tuple(n), down=tuple(turn.apply([0, -1, 0])), shift=FixedTranslation(r=(1, 2, 3))),
        stop_time=1.0,
        tolerance=TOLERANCE,
        intervals=20,
    )
    moved = turn.apply(np.array(plain["lower.frame_b.r_0"])) + np.array([1, 2, 3])
    np.testing.assert_allclose(turned["lower.frame_b.r_0"], moved, atol=1e-6)
    np.testing.assert_allclose(turned["lower.frame_a.f"], plain["lower.frame_a.f"], atol=1e-4)
