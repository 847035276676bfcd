"""Machines of ModelicaTest.MultiBody.Parts.Rotor1D, and starts of rotors."""

from __future__ import annotations

from math import pi

import numpy as np
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, fixed, part, ramp, sine
from components import (
    BevelGear1D,
    BodyBox,
    BodyCylinder,
    FixedRotation,
    FixedTranslation,
    GearConstraint,
    Revolute,
    Rotor1D,
    Spherical,
    Torque,
    World,
    rotational,
)
from tests.reference.msl.published import compare, published

ROTOR = "ModelicaTest.MultiBody.Parts.Rotor1D."


def axial_inertia(length, diameter):
    """Moment of inertia of a steel cylinder about its axis."""
    return 7700 * pi * diameter**2 / 4 * length * diameter**2 / 8


class Bevel1D(Model):
    """A gear between bodies, and the same in one dimension."""

    world = World(g=0)
    gear = GearConstraint(ratio=10, phi_b=fixed(0), w_b=fixed(0))
    cyl1, cyl2 = BodyCylinder(r=(0.4, 0, 0), diameter=0.1), BodyCylinder(r=(0.4, 0, 0), diameter=0.2)
    torque1, torque2 = Torque(torque=(sine(amplitude=2), 0, 0)), rotational.Torque(tau=sine(amplitude=2))
    inertia1 = rotational.Inertia(J=axial_inertia(0.4, 0.1), phi=fixed(0), w=fixed(0))
    inertia2, bevel = rotational.Inertia(J=axial_inertia(0.4, 0.2)), BevelGear1D(ratio=10)

    def connections(self):
        yield connect(self.world.frame_b, self.gear.bearing)
        yield connect(self.cyl1.frame_b, self.gear.frame_a)
        yield connect(self.gear.frame_b, self.cyl2.frame_a)
        yield chain(self.world, self.torque1, self.cyl1)
        yield chain(self.torque2.flange, self.inertia1, self.bevel, self.inertia2)
        yield connect(self.world.frame_b, self.bevel.frame_a)


def test_bevel_1d():
    joint = {f"gearConstraint.actuatedRevolute_b.{v}": f"gear.actuated_revolute_b.{v}" for v in ("phi", "w")}
    compare(ROTOR + "Bevel1D", Bevel1D(), joint)


def gear(ratio):
    return GearConstraint(ratio=ratio, r_a=(1, 0, 0), r_b=(1, 0, 0), phi_b=fixed(0), w_b=fixed(0))


def cylinder(length):
    return BodyCylinder(r=(length, 0, 0), diameter=0.3)


class Gears(Model):
    world, gc1, gc2 = World(), gear(5), gear(2.5)
    in1, in2, out1, out2 = cylinder(0.1), cylinder(0.1), cylinder(0.2), cylinder(0.2)
    bar1, bar2, shift = FixedTranslation(r=(0.5, 0, 0)), FixedTranslation(r=(0.5, 0, 0)), FixedTranslation(r=(0, 0, 1))
    torque1 = Torque(torque=(ramp(height=100, duration=2), 0, 0))
    torque2 = Torque(torque=(ramp(height=100, duration=2), 0, 0))

    def connections(self):
        yield chain(self.world, self.shift)
        for place, gc, drive, start, bar, end in (
            (self.world, self.gc1, self.torque1, self.in1, self.bar1, self.out1),
            (self.shift, self.gc2, self.torque2, self.in2, self.bar2, self.out2),
        ):
            yield connect(place.frame_b, gc.bearing)
            yield chain(place, drive, start.frame_a)
            yield chain(start, bar, gc.frame_a)
            yield connect(gc.frame_b, end.frame_a)


def test_gear_constraint_2():
    pairs = [(gc, v) for gc in ("gc1", "gc2") for v in ("phi", "w")]
    names = {f"{gc}.actuatedRevolute_b.{v}": f"{gc}.actuated_revolute_b.{v}" for gc, v in pairs}
    compare(ROTOR + "GearConstraint2", Gears(), names)


def driven(*n):
    return Revolute(n=n, use_axis_flange=True, phi=fixed(0), w=fixed(0))


def box(*r):
    return BodyBox(r=r, length=0.1, width=0.1)


class MovingGear(Model):
    world, revolute1, revolute2, revolute3 = World(), driven(1, 0, 0), driven(0, 1, 0), driven(0, 0, 1)
    torque1, torque2, torque3 = (
        rotational.Torque(tau=sine(amplitude=a, f=f)) for a, f in ((110, 5), (120, 6), (130, 7))
    )
    box1, box2, box3 = box(0.1, 0.1, 0.1), box(1.1, 1.2, 1.3), box(0.11, 0.12, 0.13)
    gear = GearConstraint(ratio=10, n_a=(1, 0, 0), n_b=(0, 1, 0), phi_b=fixed(0), w_b=fixed(0))

    @part
    def torque(self):
        return Torque(torque=tuple(sine(amplitude=a, f=f) for a, f in ((140, 8), (150, 9), (160, 10))))

    def connections(self):
        yield chain(self.world, self.revolute1, self.revolute2, self.revolute3, self.box1)
        for k in (1, 2, 3):
            yield connect(getattr(self, f"torque{k}").flange, getattr(self, f"revolute{k}").axis)
        yield connect(self.revolute3.frame_b, self.gear.bearing)
        yield connect(self.gear.frame_b, self.box2.frame_a)
        yield connect(self.gear.frame_a, self.box3.frame_b)
        yield chain(self.world, self.torque, self.box3)


def test_gear_constraint_3():
    """The published speed of the gear is off by 2.8e-3 of its range: two integrators at 1e-11 agree to 1e-6."""
    speed = "gear.actuated_revolute_b.w"
    joint = {f"gearConstraint.actuatedRevolute_b.{v}": f"gear.actuated_revolute_b.{v}" for v in ("phi", "w")}
    result = compare(ROTOR + "GearConstraint3", MovingGear(), joint, tolerance=3e-3, run=1e-11)
    other = ac.simulate(MovingGear(), stop_time=result.time[-1], intervals=2000, tolerance=1e-12, method="idas")
    np.testing.assert_allclose(result[speed], other[speed], atol=1e-6 * np.ptp(other[speed]))


SPIN = 8.726646259971648


class Gyros(Model):
    """A wheel on a pendulum as a body on a joint, and as a rotor on a body."""

    world = World()
    ball1 = Spherical(angles_fixed=True, w_rel_a=fixed((0, 0, 0)))
    ball2 = Spherical(angles_fixed=True, w_rel_a=fixed((0, 0, 0)))
    bodyCylinder1, bodyCylinder3 = (BodyCylinder(r=(0.25, 0, 0), diameter=0.05) for _ in range(2))
    bent1, bent2 = (FixedRotation(n=(0, 1, 0), angle=pi / 4) for _ in range(2))
    revolute = Revolute(n=(1, 0, 0), phi=fixed(0), w=fixed(SPIN))
    bar1, bar2 = (FixedTranslation(r=(-0.1, 0, 0)) for _ in range(2))
    bodyCylinder2, bodyCylinder4 = (BodyCylinder(r=(0.2, 0, 0), diameter=0.1) for _ in range(2))
    rotor1D = Rotor1D(J=axial_inertia(0.2, 0.1), n=(1, 0, 0), phi=fixed(0), w=fixed(SPIN))

    def connections(self):
        yield chain(
            self.world, self.ball1, self.bodyCylinder1, self.bent1, self.revolute, self.bar1, self.bodyCylinder2
        )
        yield chain(self.world, self.ball2, self.bodyCylinder3, self.bent2, self.bar2, self.bodyCylinder4)
        yield connect(self.bent2.frame_b, self.rotor1D.frame_a)


def test_rotor_1d():
    """Quaternions are compared as rotation matrices, whose entries lie between -1 and 1."""
    name = ROTOR + "Rotor1D_1"
    quaternions = tuple(f"bodyCylinder{b}.body.Q[{k}]" for b in (2, 3) for k in (1, 2, 3, 4))
    names = {f"bodyCylinder{b}.body.w_a[{k}]": f"bodyCylinder{b}.w_a[{k}]" for b in (2, 3) for k in (1, 2, 3)}
    result = compare(name, Gyros(), names, left_out=quaternions, most_left_out=8, run=1e-9)
    data = published()[name]
    for b in (2, 3):
        Q = np.array([data[f"bodyCylinder{b}.body.Q[{k}]"] for k in (1, 2, 3, 4)]).T
        T = np.swapaxes(Rotation.from_quat(Q).as_matrix(), 1, 2)
        ours = result[f"bodyCylinder{b}.frame_a.R.T"]
        got = [np.interp(data["time"], result.time, ours[:, i, j]) for i in range(3) for j in range(3)]
        np.testing.assert_allclose(np.array(got).T.reshape(-1, 3, 3), T, atol=1e-3)


def rotor(phi=0.0, w=0.0):
    return Rotor1D(J=1, phi=fixed(phi), w=fixed(w))


class Starts(Model):
    """Rotors whose starts are given by angle and speed, or by acceleration where a spring drives them."""

    world = World()
    rotor1D1, rotor1D3, rotor1D4, rotor1D2 = rotor(), rotor(), rotor(), rotor(pi / 2, 1.74532925199433)
    rotor1D5, rotor1D6 = Rotor1D(J=1, phi=fixed(0), w=fixed(0), a=fixed(0)), Rotor1D(J=1, w=fixed(0))
    rotor1D8, rotor1D10 = Rotor1D(J=1, w=fixed(0)), Rotor1D(J=1, w=fixed(0))
    spring, spring1, spring2 = (rotational.Spring(c=1e4) for _ in range(3))

    @part
    def rotor1D7(self):
        return Rotor1D(J=1, phi=fixed(pi / 180), w=fixed(2 * pi / 180), a=fixed(3 * pi / 180))

    @part
    def rotor1D9(self):
        return Rotor1D(J=1, phi=fixed(pi / 180), w=fixed(2 * pi / 180), a=fixed(3 * pi / 180))

    def connections(self):
        for k in range(1, 11):
            yield connect(self.world.frame_b, getattr(self, f"rotor1D{k}").frame_a)
        yield chain(self.rotor1D5, self.spring, self.rotor1D6)
        yield chain(self.rotor1D7, self.spring1, self.rotor1D8)
        yield chain(self.rotor1D9, self.spring2, self.rotor1D10)


def test_starts_of_rotors():
    """The published phase of the two oscillations is late, which makes 1 % of their speeds; they are known exactly."""
    result = compare("ModelicaTest.MultiBody.InitializationConversion.Rotor1D", Starts(), tolerance=1.1e-2, run=1e-10)
    w, (w_9, a_9) = np.sqrt(2e4), np.deg2rad([2, 3])
    w_rel = -a_9 / 1e4 * w * np.sin(w * result.time) - w_9 * np.cos(w * result.time)
    for first, second in (("rotor1D9", "rotor1D10"), ("rotor1D7", "rotor1D8")):
        np.testing.assert_allclose(result[f"{first}.w"], (w_9 - w_rel) / 2, atol=1e-7)
        np.testing.assert_allclose(result[f"{second}.w"], (w_9 + w_rel) / 2, atol=1e-7)
