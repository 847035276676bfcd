"""Screws, racks, constant-velocity joints and curves against closed forms, in closed loops as well."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Model, chain, connect, cos, fixed, guess, part, sin, structural, time
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    ConstantVelocityJoint,
    FixedRotation,
    FixedTranslation,
    PointMass,
    PointOnCurve,
    Prismatic,
    RackAndPinion,
    Revolute,
    ScrewJoint,
    Universal,
    World,
    rotational,
)

g = 9.80665


class Nut(Model):
    """A nut on a vertical spindle that stands still."""

    world = World(n=(0, 0, -1))
    screw, nut = ScrewJoint(n=(0, 0, 1), pitch=-0.3, phi=fixed(0), w=fixed(0)), Body(m=2, I=0.01 * np.eye(3))

    def connections(self):
        yield chain(self.world, self.screw, self.nut)


def test_nut_falls():
    """(m + I (2 pi / pitch)^2) a = -m g."""
    result = ac.simulate(Nut(), stop_time=0.5)
    fall = -2 * g / (2 + 0.01 * (2 * pi / 0.3) ** 2) * result.time**2 / 2
    np.testing.assert_allclose(result["screw.s"], fall, atol=1e-6)
    np.testing.assert_allclose(result["screw.phi"], -2 * pi / 0.3 * fall, atol=1e-5)


class Jack(Model):
    """A motor turns a spindle, whose nut is the slider of a crank; the loop keeps the nut from turning."""

    world, ground = World(), FixedTranslation(r=(1, 0, 0))
    bearing, motor = Revolute(n=(1, 0, 0), phi=fixed(0), w=fixed(0), use_axis_flange=True), rotational.Torque(tau=1)
    spindle, screw = BodyCylinder(r=(0.5, 0, 0), diameter=0.05), ScrewJoint(n=(1, 0, 0), pitch=0.2, phi=guess(0))
    nut, rod, crank = (
        Body(m=1, I=0.01 * np.eye(3)),
        BodyBox(r=(0.5, 0, 0), width=0.03),
        BodyBox(r=(0.3, 0, 0), width=0.03),
    )
    pin1, pin2, pin3 = Revolute(phi=guess(1)), Revolute(phi=guess(-2)), Revolute()

    def connections(self):
        yield chain(self.world, self.bearing, self.spindle, self.screw, self.nut.frame_a)
        yield chain(self.nut.frame_a, self.pin1, self.rod, self.pin2, self.crank, self.pin3, self.ground.frame_b)
        yield connect(self.world.frame_b, self.ground.frame_a)
        yield connect(self.motor.flange, self.bearing.axis)


def test_screw_in_a_loop():
    result = ac.simulate(Jack(), stop_time=0.25, tolerance=1e-8, energy=True)
    turned, x = result["bearing.phi"], result["nut.r_0"][:, 0]
    assert turned[-1] > 2 * pi * 0.8
    np.testing.assert_allclose(x, 0.5 - 0.2 * turned / (2 * pi), atol=1e-9)
    pin = result["pin2.frame_a.r_0"]
    np.testing.assert_allclose(np.hypot(pin[:, 0] - x, pin[:, 1]), 0.5, atol=1e-9)
    np.testing.assert_allclose(np.hypot(pin[:, 0] - 1, pin[:, 1]), 0.3, atol=1e-9)
    assert abs(result.stats.energy_method) < 1e-6


R, ARM, ROD = 0.2, 0.1, 0.5


class Steering(Model):
    """A pinion, on whose arm a rod drives a slider, pushes a mass on the rack."""

    world, gear = World(gravity=None), RackAndPinion(radius=R, phi=fixed(0.3), w=fixed(4))
    pinion, load = Body(m=1, I=0.02 * np.eye(3)), Body(m=3)
    arm, pin1, rod, pin2 = FixedTranslation(r=(0, ARM, 0)), Revolute(), FixedTranslation(r=(ROD, 0, 0)), Revolute()
    slide, slider = Prismatic(s=guess(0.45)), Body(m=5)

    def connections(self):
        yield connect(self.world.frame_b, self.gear.bearing)
        yield chain(self.gear.frame_a, self.arm, self.pin1, self.rod, self.pin2, self.slider.frame_a)
        yield chain(self.world, self.slide, self.slider.frame_a)
        yield connect(self.gear.frame_a, self.pinion.frame_a)
        yield connect(self.gear.frame_b, self.load.frame_a)


def test_rack_in_a_loop():
    """The sum of the kinetic energies is constant: (I + m R^2 + m_s (ds/dphi)^2) w^2 / 2."""
    result = ac.simulate(Steering(), stop_time=3, tolerance=1e-9)
    phi, w = result["gear.phi"], result["gear.w"]
    up, aside = ARM * np.cos(phi), -ARM * np.sin(phi)
    lever = -up - up * aside / np.sqrt(ROD**2 - up**2)
    np.testing.assert_allclose(result["load.r_0"][:, 0], R * phi, atol=1e-9)
    np.testing.assert_allclose(result["slide.s"], aside + np.sqrt(ROD**2 - up**2), atol=1e-8)
    energy = (0.02 + 3 * R**2 + 5 * lever**2) * w**2 / 2
    assert np.ptp(w) > 0.1
    np.testing.assert_allclose(energy, energy[0], rtol=1e-6)


BEND = 0.6


class Shafts(Model):
    """A motor drives a shaft through a joint, at an angle between fixed bearings."""

    constant = structural("whether the joint is a constant-velocity joint", default=True)
    world, corner = World(gravity=None), FixedRotation(n=(0, 0, 1), angle=BEND)
    one, two = Revolute(n=(1, 0, 0), phi=fixed(0), w=fixed(3), use_axis_flange=True), Revolute(n=(1, 0, 0))
    shaft1, shaft2 = Body(m=1, I=0.02 * np.eye(3)), Body(m=1, I=0.03 * np.eye(3))
    motor = rotational.Torque(tau=0.5)

    @part
    def it(self):
        bend = guess((0, 2 * np.tan(BEND / 2)))
        return (
            ConstantVelocityJoint(theta=bend)
            if self.constant
            else Universal(n_a=(0, 1, 0), n_b=(0, 0, 1), phi_b=guess(BEND))
        )

    def connections(self):
        yield chain(self.world, self.one, self.it, self.two.frame_b)
        yield chain(self.world, self.corner, self.two)
        yield connect(self.it.frame_a, self.shaft1.frame_a)
        yield connect(self.it.frame_b, self.shaft2.frame_a)
        yield connect(self.motor.flange, self.one.axis)


def test_constant_velocity_joint():
    """Both shafts turn alike, (I1 + I2) der(w) = tau; the second does not through a universal joint."""
    run = {"stop_time": 1, "tolerance": 1e-9}
    result, other = (ac.simulate(Shafts(constant=constant), **run) for constant in (True, False))
    np.testing.assert_allclose(result["two.w"], result["one.w"], atol=1e-9)
    np.testing.assert_allclose(result["one.w"], 3 + 0.5 / 0.05 * result.time, atol=1e-6)
    across, a = np.sin(BEND) ** 2, other["one.phi"]
    np.testing.assert_allclose(other["two.w"], other["one.w"] * np.cos(BEND) / (1 - across * np.cos(a) ** 2), rtol=1e-6)


class Bead(Model):
    """A bead on a wire in the form of a helix."""

    world, bead = World(n=(0, 0, -1)), PointMass(m=2)
    wire = PointOnCurve(curve=lambda u: (0.3 * cos(u), 0.3 * sin(u), 0.1 * u), u=fixed(0.5), der_u=fixed(2))

    def connections(self):
        yield chain(self.world, self.wire, self.bead)


def test_bead_on_a_helix():
    """(R^2 + h^2) der2_u = -g h; across the wire, the force carries the bead and holds it on the circle."""
    result = ac.simulate(Bead(), stop_time=1, tolerance=1e-9)
    slope = -g * 0.1 / (0.3**2 + 0.1**2)
    np.testing.assert_allclose(result["wire.u"], 0.5 + 2 * result.time + slope * result.time**2 / 2, atol=1e-8)
    inwards = -np.cos(0.5) * 0.3 * 4 - np.sin(0.5) * 0.3 * slope
    assert result["wire.f"][0] == pytest.approx(
        [2 * inwards, 2 * (-np.sin(0.5) * 1.2 + np.cos(0.5) * 0.3 * slope), 2 * (g + 0.1 * slope)]
    )


def test_body_loops_the_loop():
    """The angle on a hoop: der2_u = -g / R cos(u), whatever the body turns by."""
    body = Body(m=2, I=0.1 * np.eye(3), w_a=fixed((1, 2, 3)), angles_fixed=True)
    hoop = PointOnCurve(curve=lambda u: (0.3 * cos(u), 0, 0.3 * sin(u)), u=fixed(0.5), der_u=fixed(15))
    result = ac.simulate(Bead(bead=body, wire=hoop), stop_time=2, tolerance=1e-8)
    known = solve_ivp(lambda t, y: [y[1], -g / 0.3 * np.cos(y[0])], (0, 2), [0.5, 15], t_eval=result.time, rtol=1e-11)
    assert known.y[0, -1] > 8 * pi
    np.testing.assert_allclose(result["wire.u"], known.y[0], atol=1e-5)


class Cam(Model):
    """An eccentric disc lifts a follower."""

    world, follower = World(), Body(m=1)
    drive, bearing = rotational.Position(phi_ref=2 * time + 0.3 * time**2), Revolute(use_axis_flange=True)
    cam = PointOnCurve(curve=lambda u: (0.1 + 0.3 * cos(u), 0.3 * sin(u), 0), u=guess(1.5))
    guide = Prismatic(n=(0, 1, 0), s=guess(0.3))

    def connections(self):
        yield chain(self.world, self.bearing, self.cam, self.follower.frame_a)
        yield chain(self.world, self.guide, self.follower.frame_a)
        yield connect(self.drive.flange, self.bearing.axis)


def test_cam_lifts_a_follower():
    result = ac.simulate(Cam(), stop_time=3, tolerance=1e-8)
    phi = 2 * result.time + 0.3 * result.time**2
    np.testing.assert_allclose(
        result["guide.s"], 0.1 * np.sin(phi) + np.sqrt(0.09 - 0.01 * np.cos(phi) ** 2), atol=1e-9
    )


def refused(model: Model, message: str) -> None:
    with pytest.raises(ac.AcausalError, match=message):
        ac.simulate(model, stop_time=0.1)


def test_wrong_input():
    refused(
        Bead(wire=PointOnCurve(curve=3, u=fixed(0), der_u=fixed(0))), "`curve` is not a function; give a function of u"
    )
    refused(
        Bead(wire=PointOnCurve(curve=lambda u: (u, u), u=fixed(0), der_u=fixed(0))), "does not return three coordinates"
    )
    flat = PointOnCurve(curve=lambda u: (u**2, u**3, 0), u=fixed(0), der_u=fixed(0))
    refused(Bead(wire=flat), "no tangent at the start")
    refused(Steering(gear=RackAndPinion(radius=R, n_a=(1, 0, 0.1))), "`n_b` is not perpendicular to `n_a`")
    refused(Nut(screw=ScrewJoint(n=(0, 0, 0), pitch=1)), "`n` has length 0")
