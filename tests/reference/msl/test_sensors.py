"""Machines of ModelicaTest.MultiBody.Sensors."""

from __future__ import annotations

from math import pi

import numpy as np

from acausal import Model, chain, connect, fixed
from components import Body, BodyBox, Fixed, FixedRotation, FixedTranslation, Revolute, World, WorldForce, rotational
from components.sensors import AbsoluteSensor, CutForce, CutForceAndTorque, Distance
from tests.reference.msl.published import compare

SENSORS = "ModelicaTest.MultiBody.Sensors."


class Absolute(Model):
    world, freeMotion = World(), AbsoluteSensor(resolve_in_frame="world")
    turned = FixedRotation(r=(0.5, 0.5, 0.1), rotation_type="sequence", angles=(pi / 4, pi / 4, pi / 4))

    def connections(self):
        yield chain(self.world, self.turned, self.freeMotion)


def test_absolute_sensor_2():
    compare(SENSORS + "AbsoluteSensor2", Absolute(), tolerance=1e-6)


class Cut(Model):
    world, cutForce, push = World(), CutForce(), WorldForce(force=(500, 0, 0))
    turned = FixedRotation(r=(0.5, 0.5, 0.1), rotation_type="sequence")

    def connections(self):
        yield chain(self.world, self.turned, self.cutForce, self.push)


def test_cut_force():
    compare(SENSORS + "CutForce2", Cut(), tolerance=1e-6)
    compare(SENSORS + "CutForce3", Cut(), tolerance=1e-6)


def bent(z):
    return FixedRotation(r=(0, 0, z), n=(0, 0, 1), angle=pi / 2)


class Cuts(Model):
    """Four arms, whose loads are resolved in different frames."""

    world = World(n=(0, 0, -1))
    bent1a, bent2a, bent1b, bent2b = bent(-0.2), bent(0.2), bent(-0.6), bent(0.6)
    cut1a, cut2a = CutForceAndTorque(), CutForceAndTorque(positive_sign=False, resolve_in_frame="world")
    cut1b = CutForceAndTorque(resolve_in_frame="frame_resolve")
    cut2b = CutForceAndTorque(resolve_in_frame="frame_resolve", positive_sign=False)
    arm1a, arm2a, arm1b, arm2b = (FixedTranslation(r=(0, -1, 0)) for _ in range(4))
    body1a, body2a, body1b, body2b = (Body(m=1) for _ in range(4))

    def connections(self):
        for k in ("1a", "2a", "1b", "2b"):
            yield chain(self.world, *(getattr(self, f"{part}{k}") for part in ("bent", "cut", "arm", "body")))
        yield connect(self.cut1b.frame_resolve, self.bent1b.frame_b)
        yield connect(self.cut2b.frame_resolve, self.world.frame_b)


def test_cut_force_and_torque():
    each = [(k, v, i) for k in ("1a", "2a", "1b", "2b") for v in ("force", "torque") for i in (1, 2, 3)]
    compare(
        SENSORS + "CutForceAndTorque2",
        Cuts(),
        {f"cutForce{k}.{v}[{i}]": f"cut{k}.{v}[{i}]" for k, v, i in each},
        tolerance=1e-6,
    )
    compare(
        SENSORS + "CutTorque",
        Cuts(),
        {f"cutTorque{k}.{v}[{i}]": f"cut{k}.{v}[{i}]" for k, v, i in each},
        tolerance=1e-6,
    )


class Swinging(Model):
    world, rev, damper = World(), Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0)), rotational.Damper(d=0.1)
    box, below, Distance1 = BodyBox(r=(0.5, 0, 0)), Fixed(r=(0, -1, 0)), Distance()

    def connections(self):
        yield chain(self.world, self.rev, self.box)
        yield chain(self.rev.support, self.damper, self.rev.axis)
        yield chain(self.below, self.Distance1, self.box.frame_b)


def test_distance():
    compare(SENSORS + "Distance", Swinging())


class Passing(Model):
    world, hinge, box = World(), Revolute(phi=fixed(pi / 6), w=fixed(0)), BodyBox(r=(1, 0, 0), width=0.08)
    beside, distance1, distance2 = Fixed(r=(1, 0, 0)), Distance(), Distance()

    def connections(self):
        yield chain(self.world, self.hinge, self.box, self.distance1, self.beside.frame_b)
        yield connect(self.hinge.frame_a, self.distance2.frame_a)
        yield connect(self.hinge.frame_b, self.distance2.frame_b)


def test_distance_2():
    result = compare(SENSORS + "Distance2", Passing())
    phi = result["hinge.phi"]
    np.testing.assert_allclose(result["distance1.distance"], 2 * np.abs(np.sin(phi / 2)), atol=1e-12)
