"""Machines of Modelica.Mechanics.Rotational.Examples and ModelicaTest.Rotational."""

from __future__ import annotations

from math import pi

import numpy as np

from acausal import Model, chain, connect, fixed, guess, ramp, sine, step
from components import Body, Revolute, World, translational
from components.rotational import (
    Damper,
    ElastoBacklash,
    ElastoBacklash2,
    Fixed,
    IdealGear,
    IdealRollingWheel,
    Inertia,
    Move,
    MultiSensor,
    RelativeStates,
    Speed,
    Spring,
    SpringDamper,
    Torque,
    TorqueStep,
)
from tests.reference.msl.published import compare

EXAMPLES = "Modelica.Mechanics.Rotational.Examples."
GUIDE = "ModelicaTest.Rotational.ForUsersGuide."


def resting(J):
    return Inertia(J=J, phi=fixed(0), w=fixed(0))


class First(Model):
    ground, torque = Fixed(), Torque(tau=sine(amplitude=10, f=5), use_support=True)
    inertia1, idealGear, inertia2 = Inertia(J=0.1), IdealGear(ratio=10, use_support=True), resting(2)
    spring, inertia3, damper = Spring(c=1e4, phi_rel=fixed(0)), Inertia(J=2, w=fixed(0)), Damper(d=10)

    def connections(self):
        yield chain(self.torque.flange, self.inertia1, self.idealGear, self.inertia2, self.spring, self.inertia3)
        yield chain(self.inertia2, self.damper, self.ground.flange)
        yield from self.housings()

    def housings(self):
        yield connect(self.torque.support, self.ground.flange)
        yield connect(self.idealGear.support, self.ground.flange)


def test_first():
    compare(EXAMPLES + "First", First())


class FirstGrounded(First):
    torque, idealGear = Torque(tau=sine(amplitude=10, f=5)), IdealGear(ratio=10)

    def housings(self):
        yield from ()


def test_first_grounded():
    compare(EXAMPLES + "FirstGrounded", FirstGrounded())


def turned():
    return Inertia(J=5, phi=fixed(pi / 2), w=fixed(0))


class Backlash(Model):
    ground, inertia1, inertia2, inertia3 = Fixed(), turned(), turned(), turned()
    springDamper = SpringDamper(c=20e3, d=50)
    elastoBacklash, elastoBacklash2 = ElastoBacklash(c=20e3, d=50, b=pi / 4), ElastoBacklash2(c=20e3, d=50, b=pi / 4)

    def connections(self):
        yield chain(self.ground.flange, self.springDamper, self.inertia1)
        yield chain(self.ground.flange, self.elastoBacklash, self.inertia2)
        yield chain(self.ground.flange, self.elastoBacklash2, self.inertia3)


def test_backlash():
    compare(EXAMPLES + "Backlash", Backlash())


class ElasticBearing(Model):
    ground, torque = Fixed(), Torque(tau=ramp(height=100, duration=5), use_support=True)
    shaft, idealGear = resting(1), IdealGear(ratio=3, use_support=True)
    spring, load = Spring(c=1e3, phi_rel=fixed(0)), Inertia(J=50, w=fixed(0))
    springDamper, multiSensor, housing = (
        SpringDamper(c=1e5, d=5, phi_rel=fixed(0), w_rel=fixed(0)),
        MultiSensor(),
        Inertia(J=5),
    )

    def connections(self):
        yield chain(self.torque.flange, self.shaft, self.idealGear, self.spring, self.load)
        yield connect(self.torque.support, self.ground.flange)
        yield chain(self.ground.flange, self.springDamper, self.multiSensor, self.housing, self.idealGear.support)


def test_elastic_bearing():
    compare(EXAMPLES + "ElasticBearing", ElasticBearing(), run=1e-9)  # w_rel of the bearing stays below 1e-3 rad/s


class RollingWheel(Model):
    torque, inertia, wheel = TorqueStep(step_torque=10, start_time=0.1), resting(1), IdealRollingWheel(radius=1)
    mass = translational.Mass(m=1)
    drag = translational.QuadraticSpeedDependentForce(f_nominal=-10, v_nominal=5, force_direction=False)

    def connections(self):
        yield chain(self.torque.flange, self.inertia, self.wheel, self.mass, self.drag.flange)


def test_rolling_wheel():
    compare(EXAMPLES + "RollingWheel", RollingWheel())


class Directions(Model):
    torque, torque1, torque2 = Torque(tau=sine(f=1)), Torque(tau=sine(f=1)), Torque(tau=sine(f=1))
    J1, J3, J5 = resting(0.2), resting(0.2), resting(0.2)
    gear, gear1, gear2 = IdealGear(ratio=5), IdealGear(ratio=1 / 5), IdealGear(ratio=1 / 5)
    J2, J4, J6 = Inertia(J=5), Inertia(J=5), Inertia(J=5)

    def connections(self):
        yield chain(self.torque.flange, self.J1, self.gear, self.J2)
        yield chain(self.torque1.flange, self.J3, self.gear1.flange_b)
        yield chain(self.gear1.flange_a, self.J4)
        yield chain(self.torque2.flange, self.J5, self.gear2.flange_b)
        yield connect(self.gear2.flange_a, self.J6.flange_b)


def test_directions():
    compare(GUIDE + "Directions", Directions())


class Directions3(Model):
    J1, J2, J3, J4 = resting(1), Inertia(J=1), resting(1), Inertia(J=1)

    def connections(self):
        yield connect(self.J1.flange_b, self.J2.flange_b)
        yield connect(self.J3.flange_b, self.J4.flange_b)


def test_directions_3():
    compare(GUIDE + "Directions3", Directions3())


class SimpleDriveTrain(Model):
    torque, J1, gear, J2 = Torque(tau=sine(f=1)), resting(0.2), IdealGear(ratio=5), Inertia(J=5)

    def connections(self):
        yield chain(self.torque.flange, self.J1, self.gear, self.J2)


def test_simple_drive_train():
    compare(GUIDE + "SimpleDriveTrain", SimpleDriveTrain())


class SpringDampers(Model):
    """Starts that are given by the springs, by their accelerations, or by the inertias."""

    wall, inertia1, inertia2, inertia3 = Fixed(), Inertia(J=1), Inertia(J=1), Inertia(J=1)
    inertia4, inertia5, inertia6, inertia7 = (
        Inertia(J=1, w=fixed(0)),
        Inertia(J=1, phi=fixed(0)),
        resting(1),
        Inertia(J=1),
    )
    springDamper1 = SpringDamper(c=1e4, d=10, phi_rel=fixed(1), w_rel=fixed(2))
    springDamper2 = SpringDamper(c=1e4, d=10, phi_rel=guess(-1), w_rel=fixed(-2), a_rel=fixed(0))
    springDamper3 = SpringDamper(c=1e4, d=10, phi_rel=fixed(1), w_rel=fixed(2))
    springDamper4, springDamper5 = (
        SpringDamper(c=1e4, d=10, phi_rel=fixed(0)),
        SpringDamper(c=1e4, d=10, w_rel=fixed(3)),
    )
    spring, relativeStates = Spring(c=1e4), RelativeStates(phi_rel=fixed(0), w_rel=fixed(0))

    def connections(self):
        for k in range(1, 6):
            yield chain(self.wall.flange, getattr(self, f"springDamper{k}"), getattr(self, f"inertia{k}"))
        yield chain(self.inertia6, self.spring, self.inertia7)
        yield chain(self.inertia6, self.relativeStates, self.inertia7)


def test_starts_of_springs_and_dampers():
    compare("ModelicaTest.Rotational.InitializationConversion.SpringDamper", SpringDampers())


class Speeds(Model):
    speed1, inertia1 = Speed(w_ref=step(start_time=0.5), f_crit=5, exact=False, phi=fixed(0)), Inertia(J=1)
    speed2, inertia2 = Speed(w_ref=sine(f=1), phi=fixed(0)), Inertia(J=1)
    speed3 = translational.Speed(v_ref=step(start_time=0.5), f_crit=5, exact=False, s=fixed(1))
    speed4 = translational.Speed(v_ref=sine(f=1), s=fixed(1))
    mass1, mass2 = translational.Mass(m=2), translational.Mass(m=2)

    def connections(self):
        for drive, load in (("speed1", "inertia1"), ("speed2", "inertia2"), ("speed3", "mass1"), ("speed4", "mass2")):
            yield chain(getattr(self, drive).flange, getattr(self, load))


def test_speed():
    compare("ModelicaTest.Rotational.TestSpeed", Speeds())


class Moved(Model):
    """A body and a mass, accelerated by signals whose angle and speed stay 0."""

    world, ActuatedRevolute1, Body1 = (
        World(gravity=None),
        Revolute(use_axis_flange=True),
        Body(m=1, I=np.diag([0, 0, 2])),
    )
    move, move1, slidingMass = Move(u=(0, 0, 1)), translational.Move(u=(0, 0, 1)), translational.Mass(m=2)

    def connections(self):
        yield chain(self.world, self.ActuatedRevolute1, self.Body1)
        yield connect(self.move.flange, self.ActuatedRevolute1.axis)
        yield connect(self.move1.flange, self.slidingMass.flange_a)


def test_move():
    names = {f"Multiplex3_1.y[{k}]": f"move.u[{k}]" for k in (1, 2, 3)}
    names |= {"Constant1.y": "move.u[3]", "Constant2.y": "move.u[1]"}
    result = compare("ModelicaTest.Rotational.TestMove", Moved(), names)
    np.testing.assert_allclose(result["slidingMass.flange_a.f"], 2)
