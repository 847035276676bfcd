"""Machines of ModelicaTest.MultiBody.Forces and ModelicaTest.MultiBody.Parts."""

from __future__ import annotations

from math import pi

import numpy as np

from acausal import Model, Scalar, chain, connect, der, fixed, guess, part, sine, trapezoid, variable
from components import (
    Body,
    BodyCylinder,
    Damper,
    Fixed,
    FixedRotation,
    FixedTranslation,
    Force,
    LineForce,
    Prismatic,
    Revolute,
    Spring,
    World,
    WorldForce,
    WorldForceAndTorque,
    WorldTorque,
)
from components.thermal import HeatCapacitor
from tests.reference.msl.published import compare

FORCES = "ModelicaTest.MultiBody.Forces."
PARTS = "ModelicaTest.MultiBody.Parts."


def bar():
    return BodyCylinder(r=(1, 0, 0), diameter=1 / 20)


def hinge(*n):
    return Revolute(n=n or (0, 0, 1), phi=fixed(0), w=fixed(0))


class WorldForces(Model):
    world, fixed1, fixed2, fixed3 = World(), Fixed(r=(0, 0.5, 0)), Fixed(r=(0, -0.5, 0)), Fixed(r=(0, -1, 0))
    Revolute1, bar1, force = hinge(), bar(), WorldForce(force=(0, 500, 0))
    Revolute2, bar2, torque = hinge(0, 1, 0), bar(), WorldTorque(torque=(100, 100, 100))
    Revolute3, Revolute4, bar3 = hinge(), hinge(0, 1, 0), bar()
    both = WorldForceAndTorque(force=(0, 500, 0), torque=(100, 100, 100))

    def connections(self):
        yield chain(self.fixed1, self.Revolute1, self.bar1, self.force)
        yield chain(self.fixed2, self.Revolute2, self.bar2, self.torque)
        yield chain(self.fixed3, self.Revolute3, self.Revolute4, self.bar3, self.both)


def test_world_forces():
    compare(FORCES + "WorldForces", WorldForces())


def load(where):
    return WorldForceAndTorque(force=(0, 500, 0), torque=(100, 100, 100), resolve_in_frame=where)


class Loads(Model):
    """Three bars under one load, resolved in different frames."""

    world, pivot = World(), Fixed(r=(0, -1, 0))
    Revolute3, Revolute4, bar3, load3 = hinge(), hinge(0, 1, 0), bar(), load("world")
    Revolute1, Revolute2, bar1, load1 = hinge(), hinge(0, 1, 0), bar(), load("frame_resolve")
    Revolute5, Revolute6, bar2, load2 = hinge(), hinge(0, 1, 0), bar(), load("frame_b")

    def connections(self):
        yield chain(self.pivot, self.Revolute3, self.Revolute4, self.bar3, self.load3)
        yield chain(self.pivot, self.Revolute1, self.Revolute2, self.bar1, self.load1)
        yield chain(self.pivot, self.Revolute5, self.Revolute6, self.bar2, self.load2)
        yield connect(self.world.frame_b, self.load1.frame_resolve)


def test_world_force_and_torque():
    compare(FORCES + "WorldForceAndTorque", Loads())


def push(where):
    return WorldForce(force=(0, 500, 0), resolve_in_frame=where)


class FrameForces2(Model):
    world = World()
    Revolute1, Revolute2, Revolute3, Revolute4 = (hinge() for _ in range(4))
    bar1, bar2, bar3, bar4 = (bar() for _ in range(4))
    force1, force2, force3, force4 = push("frame_b"), push("frame_resolve"), push("world"), push("frame_resolve")

    def connections(self):
        for k in (1, 2, 3, 4):
            yield chain(self.world, getattr(self, f"Revolute{k}"), getattr(self, f"bar{k}"), getattr(self, f"force{k}"))
        yield connect(self.force2.frame_resolve, self.bar2.frame_b)
        yield connect(self.force4.frame_resolve, self.world.frame_b)


def test_frame_forces_2():
    compare(FORCES + "FrameForces2", FrameForces2())


def skew(where):
    return WorldForceAndTorque(force=(0, 500, 0), torque=(-100, 100, 0), resolve_in_frame=where)


class FrameForcesAndTorques(Model):
    world, turned = World(), FixedRotation(n=(0, 0, 1), angle=pi / 4)
    Revolute3, Revolute1, body1, load1 = hinge(), hinge(0, 1, 0), bar(), skew("frame_b")
    Revolute4, Revolute2, body2, load2 = hinge(), hinge(0, 1, 0), bar(), skew("frame_resolve")

    def connections(self):
        yield chain(self.world, self.Revolute3, self.Revolute1, self.body1, self.load1)
        yield chain(self.world, self.Revolute4, self.Revolute2, self.body2, self.load2)
        yield chain(self.world, self.turned, self.load2.frame_resolve)


def test_frame_forces_and_torques():
    compare(FORCES + "FrameForcesAndTorques", FrameForcesAndTorques())


class FrameForcesAndTorques3(FrameForcesAndTorques):
    turned, load1 = FixedTranslation(r=(0, 0, 1)), skew("world")


def test_frame_forces_and_torques_3():
    compare(FORCES + "FrameForcesAndTorques3", FrameForcesAndTorques3())


def twist(where):
    return WorldTorque(torque=(0, 100, 0), resolve_in_frame=where)


class FrameTorques(Model):
    world, turned = World(), FixedRotation(n=(0, 0, 1), angle=pi / 4)
    Revolute1, body1, torque1 = hinge(0, 1, 0), bar(), twist("frame_b")
    Revolute2, body2, torque2 = hinge(0, 1, 0), bar(), twist("frame_resolve")

    def connections(self):
        yield chain(self.world, self.Revolute1, self.body1, self.torque1)
        yield chain(self.world, self.Revolute2, self.body2, self.torque2)
        yield from self.resolved()

    def resolved(self):
        yield chain(self.world, self.turned, self.torque2.frame_resolve)


def test_frame_torques():
    compare(FORCES + "FrameTorques", FrameTorques())


class FrameTorques2(FrameTorques):
    turned = None
    Revolute3, body3, torque3 = hinge(0, 1, 0), bar(), twist("world")
    Revolute4, body4, torque4 = hinge(0, 1, 0), bar(), twist("frame_resolve")

    def resolved(self):
        yield chain(self.world, self.Revolute3, self.body3, self.torque3)
        yield chain(self.world, self.Revolute4, self.body4, self.torque4)
        yield connect(self.torque2.frame_resolve, self.body2.frame_b)
        yield connect(self.torque4.frame_resolve, self.Revolute4.frame_a)


def test_frame_torques_2():
    compare(FORCES + "FrameTorques2", FrameTorques2())


class UnknownDamper(LineForce):
    """A damper whose constant follows from the start."""

    d: Scalar = variable("damping constant", unit="N.s/m")

    def law(self):
        yield der(self.d) == 0
        yield self.f == self.d * self.v


class Damped(Model):
    """A mass on a rail, a damper and a force, three times: the third damper's constant follows from the acceleration."""

    d = 10
    world, capacitor = World(), HeatCapacitor(C=100, T=fixed(293.15))
    prismatic, prismatic1 = (Prismatic(s=fixed(0.5), v=fixed(-0.1)) for _ in range(2))
    prismatic2 = Prismatic(s=fixed(0.5), v=fixed(-0.1), a=fixed(0.2))
    body, body1, body2 = (Body(m=5) for _ in range(3))
    damper2 = UnknownDamper(d=guess(3))
    law = sine(amplitude=50, f=2)

    @part
    def damper(self):
        return Damper(d=self.d)

    @part
    def damper1(self):
        return Damper(d=self.d, use_heat_port=True)

    @part
    def force(self):
        return Force(force=(self.law, 0, 0))

    @part
    def force1(self):
        return Force(force=(self.law, 0, 0))

    @part
    def force2(self):
        return Force(force=(self.law, 0, 0))

    def connections(self):
        for k in ("", "1", "2"):
            joint, body = getattr(self, f"prismatic{k}"), getattr(self, f"body{k}")
            yield chain(self.world, joint, body)
            yield chain(self.world, getattr(self, f"damper{k}"), body)
            yield chain(self.world, getattr(self, f"force{k}"), body)
        yield connect(self.damper1.heat_port, self.capacitor.port)


def test_damper():
    names = {"body.frame_a.r_0[1]": "prismatic.s", "body.v_0[1]": "prismatic.v", "heatCapacitor.T": "capacitor.T"}
    compare(FORCES + "Damper", Damped(), names)


class Damped2(Damped):
    d = 310
    law = trapezoid(amplitude=50, rising=0.1, width=0.15, falling=0.1, period=0.5, offset=-30)


def test_damper_2():
    compare(FORCES + "Damper2", Damped2(), {"heatCapacitor.T": "capacitor.T"})


class UnknownSpring(LineForce):
    c: Scalar = variable("spring constant", unit="N/m")

    def law(self):
        yield der(self.c) == 0
        yield self.f == self.c * (self.s - 0.1)


class Springs(Model):
    world, arm = World(), FixedTranslation(r=(1, 0, 0))
    spring, spring1 = Spring(c=10, s_unstretched=0.1), UnknownSpring(c=guess(1))
    prismatic = Prismatic(n=(0, 1, 0), s=fixed(-1), v=fixed(0))
    prismatic1 = Prismatic(n=(0, 1, 0), s=fixed(-1), v=fixed(0), a=fixed(-0.81))
    body, body1 = Body(m=1), Body(m=1)

    def connections(self):
        yield chain(self.world, self.prismatic, self.body)
        yield chain(self.world, self.spring, self.body)
        yield chain(self.world, self.arm, self.prismatic1, self.body1)
        yield chain(self.arm, self.spring1, self.body1)


def test_spring():
    compare(FORCES + "Spring", Springs())


class Rotations(Model):
    world, tip1, tip2, tip3 = World(gravity=None), *(Body(m=1) for _ in range(3))
    fixedRotation = FixedRotation(angle=np.deg2rad(47))
    fixedRotation1 = FixedRotation(r=(1, 1, 1), rotation_type="two_axes", n_x=(0, 1, 0), n_y=(0, 0, 1))
    fixedRotation2 = FixedRotation(r=(-1, 0, 1), rotation_type="sequence", angles=tuple(np.deg2rad((30, 20, 10))))

    def connections(self):
        for k, tip in (("", self.tip1), ("1", self.tip2), ("2", self.tip3)):
            yield chain(self.world, getattr(self, f"fixedRotation{k}"), tip)


def test_fixed_rotation():
    compare(PARTS + "FixedRotation", Rotations(), tolerance=1e-6)


class Translated(Model):
    world, fixed1, fixedTranslation = World(gravity=None), Fixed(), FixedTranslation(r=(1, 0.5, 0))

    def connections(self):
        yield chain(self.fixed1, self.fixedTranslation)


def test_fixed_translation():
    compare(PARTS + "FixedTranslation", Translated(), tolerance=1e-6)
