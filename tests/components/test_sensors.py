"""Sensors against motions computed otherwise."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, fixed, observed
from components import Body, FixedTranslation, Revolute, Spherical, World, sensors
from components.sensors import (
    AbsoluteAngles,
    AbsoluteAngularVelocity,
    AbsolutePosition,
    AbsoluteSensor,
    AbsoluteVelocity,
    CutForceAndTorque,
    Distance,
    Power,
    RelativeAngles,
    RelativeSensor,
    RelativeVelocity,
)

SEQUENCES = [(1, 2, 3), (3, 2, 1), (2, 3, 1), (1, 3, 2), (1, 2, 1), (3, 1, 3), (2, 1, 2)]


class Tumbling(Model):
    """A free body, a frame on a turning arm beside it, and every sensor between them."""

    world, body = (
        World(),
        Body(
            m=2.0,
            I=np.diag([0.2, 0.3, 0.4]),
            v_0=fixed((1, 2, 0.5)),
            w_a=fixed((1, 2, 1.5)),
            r_0=fixed((0, 0, 0)),
            angles_fixed=True,
            angles_start=(0.3, -0.2, 0.5),
        ),
    )
    joint, arm, tip = (
        Revolute(n=(0, 1, 2), phi=fixed(0.4), w=fixed(3.0)),
        FixedTranslation(r=(0.4, 0.1, 0.2)),
        Body(m=1, I=np.diag([0.1, 0.1, 0.1])),
    )
    absolute, relative, seen = AbsoluteSensor(), RelativeSensor(), RelativeVelocity(resolve_in_frame="world")
    gap, cut, power = Distance(), CutForceAndTorque(resolve_in_frame="world"), Power()
    many = tuple(AbsoluteAngles(sequence=s) for s in SEQUENCES)
    between = RelativeAngles(sequence=(3, 1, 2))

    def connections(self):
        yield chain(self.world, self.joint, self.power, self.arm, self.cut, self.tip)
        for sensor in (self.relative, self.seen, self.gap, self.between):
            yield connect(sensor.frame_a, self.arm.frame_b)
            yield connect(sensor.frame_b, self.body.frame_a)
        for sensor in (self.absolute, *self.many):
            yield connect(sensor.frame_a, self.body.frame_a)

    @observed
    def speed(self):
        """Velocity of the body, resolved in the arm."""
        return sensors.absolute_velocity(self.body.frame_a, self.arm.frame_b)


@pytest.fixture(scope="module")
def result():
    return ac.simulate(Tumbling(), stop_time=1.0, intervals=1000, tolerance=1e-10)


def turned(T, x):
    return np.einsum("kij,kj->ki", T, x)


def test_absolute_sensor(result):
    T = result["body.frame_a.R.T"]
    np.testing.assert_allclose(result["absolute.r"], turned(T, result["body.r_0"]), atol=1e-12)
    np.testing.assert_allclose(result["absolute.v"], turned(T, result["body.v_0"]), atol=1e-12)
    np.testing.assert_allclose(result["absolute.a"], turned(T, result["body.a_0"]), atol=1e-10)
    np.testing.assert_allclose(result["absolute.w"], result["body.w_a"], atol=1e-12)
    np.testing.assert_allclose(result["absolute.z"], result["body.z_a"], atol=1e-10)
    arm = result["arm.frame_b.R.T"]
    np.testing.assert_allclose(result["speed"], turned(arm, result["body.v_0"]), atol=1e-12)


@pytest.mark.parametrize("k", range(len(SEQUENCES)))
def test_angles_give_the_orientation_back(result, k):
    angles, sequence = result[f"many[{k}].angles"], SEQUENCES[k]
    name = "".join("XYZ"[axis - 1] for axis in sequence)
    again = Rotation.from_euler(name, angles).as_matrix()
    np.testing.assert_allclose(np.swapaxes(again, 1, 2), result["body.frame_a.R.T"], atol=1e-9)
    assert np.all(np.abs(angles[:, 0]) <= np.pi / 2 + 1e-12)


def test_relative_angles(result):
    T = result["body.frame_a.R.T"] @ np.swapaxes(result["arm.frame_b.R.T"], 1, 2)
    again = Rotation.from_euler("ZXY", result["between.angles"]).as_matrix()
    np.testing.assert_allclose(np.swapaxes(again, 1, 2), T, atol=1e-9)


def test_relative_sensor(result):
    a, b = result["arm.frame_b.R.T"], result["body.frame_a.R.T"]
    r = turned(a, result["body.r_0"] - result["arm.frame_b.r_0"])
    np.testing.assert_allclose(result["relative.r_rel"], r, atol=1e-12)
    t = result.time
    for value, rate in (("r_rel", "v_rel"), ("v_rel", "a_rel"), ("w_rel", "z_rel")):
        slope = np.gradient(result[f"relative.{value}"], t, axis=0, edge_order=2)
        np.testing.assert_allclose(result[f"relative.{rate}"][1:-1], slope[1:-1], rtol=1e-4, atol=2e-3)
    np.testing.assert_allclose(result["seen.v_rel"], turned(np.swapaxes(a, 1, 2), result["relative.v_rel"]), atol=1e-10)
    w = turned(a @ np.swapaxes(b, 1, 2), result["body.w_a"]) - result["arm.frame_b.R.w"]
    np.testing.assert_allclose(result["relative.w_rel"], w, atol=1e-12)
    np.testing.assert_allclose(result["gap.distance"], np.linalg.norm(r, axis=1), atol=1e-12)


def test_cut_loads_and_power(result):
    """What the cut carries moves the tip; the power is the rate of the tip's energy."""
    force = result["cut.force"] + 1.0 * 9.80665 * np.array([0, -1, 0])
    np.testing.assert_allclose(force, 1.0 * result["tip.a_0"], atol=1e-9)
    T = result["tip.frame_a.R.T"]
    spin = result["tip.w_a"]
    rate = 0.1 * result["tip.z_a"] + np.cross(spin, 0.1 * spin)
    np.testing.assert_allclose(result["cut.torque"], turned(np.swapaxes(T, 1, 2), rate), atol=1e-9)
    energy = (
        np.sum(result["tip.v_0"] ** 2, axis=1) / 2 + 0.05 * np.sum(spin**2, axis=1) + 9.80665 * result["tip.r_0"][:, 1]
    )
    slope = np.gradient(energy, result.time, edge_order=2)
    np.testing.assert_allclose(result["power.power"][1:-1], slope[1:-1], atol=2e-3)


class Turning(Model):
    """A point at (2, 0, 0) of a frame that turns about z by 3 rad/s."""

    world, joint = World(gravity=None), Revolute(phi=fixed(0.4), w=fixed(3.0))
    arm, body = FixedTranslation(r=(2, 0, 0)), Body(m=1, I=np.eye(3))
    position, velocity, rate = AbsolutePosition(), AbsoluteVelocity(), AbsoluteAngularVelocity()

    def connections(self):
        yield chain(self.world, self.joint, self.body)
        yield chain(self.joint, self.arm)
        for sensor in (self.position, self.velocity, self.rate):
            yield connect(self.arm.frame_b, sensor.frame_a)


def test_what_absolute_sensors_measure_is_resolved_in_their_frame():
    result = ac.simulate(Turning(), stop_time=1.0, tolerance=1e-9)
    for measured, value in (("position.r", (2, 0, 0)), ("velocity.v", (0, 6, 0)), ("rate.w", (0, 0, 3))):
        np.testing.assert_allclose(result[measured], np.tile(value, (len(result.time), 1)), atol=1e-7)


@pytest.mark.parametrize("sequence", [(1, 1, 2), (0, 1, 2), (1, 2, 4)])
def test_axes_that_are_none(sequence):
    class Wrong(Model):
        world, joint, tip = World(), Spherical(), Body(m=1)
        it = AbsoluteAngles(sequence=sequence)

        def connections(self):
            yield chain(self.world, self.joint, self.tip, self.it)

    with pytest.raises(ac.DeclarationError, match="`sequence` is"):
        ac.compile(Wrong())
