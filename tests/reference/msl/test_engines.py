"""Engines of Modelica.Mechanics.MultiBody.Examples.Loops, with plain joints in place of their assemblies."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest

from acausal import (
    Component,
    Model,
    Scalar,
    chain,
    connect,
    der,
    fixed,
    guess,
    parameter,
    part,
    structural,
    variable,
)
from components import (
    Body,
    BodyBox,
    BodyCylinder,
    BodyShape,
    FixedRotation,
    FixedTranslation,
    Frame,
    Prismatic,
    Revolute,
    RevolutePlanarLoopConstraint,
    World,
)
from components.rotational import Inertia, QuadraticSpeedDependentTorque, TorqueSensor
from tests.reference.msl.gas_force import GasForce
from tests.reference.msl.published import compare

LOOPS = "Modelica.Mechanics.MultiBody.Examples.Loops."
X, DOWN = (1, 0, 0), (0, -1, 0)


class Engine(Model):
    """One cylinder on a crank with a flywheel."""

    world, bearing, inertia = World(), Revolute(n=X, use_axis_flange=True), Inertia(J=1, phi=fixed(0), w=fixed(10))
    crank1, crank3 = BodyCylinder(r=(0.1, 0, 0), diameter=0.05), BodyCylinder(r=(0.1, 0, 0), diameter=0.03)
    crank2 = BodyBox(r=(0, 0.1, 0), width=0.02, height=0.05, width_direction=X)
    crank4 = BodyBox(r=(0, -0.1, 0), width=0.02, height=0.05, width_direction=X)
    mid, cylPosition = FixedTranslation(r=(0.05, 0, 0)), FixedTranslation(r=(0.15, 0.45, 0))
    pin, wrist = Revolute(n=X), RevolutePlanarLoopConstraint(n=X)
    connectingRod = BodyBox(r=(0, -0.2, 0), width=0.02, height=0.06, width_direction=X)
    slide, piston = Prismatic(n=DOWN, use_axis_flange=True), BodyCylinder(r=(0, -0.1, 0), diameter=0.1)
    gasForce = GasForce(d=0.1, L=0.35)

    def connections(self):
        yield chain(self.world, self.bearing, self.crank1, self.crank2, self.crank3, self.crank4)
        yield connect(self.inertia.flange_b, self.bearing.axis)
        yield chain(self.crank2, self.mid, self.pin, self.connectingRod.frame_b)
        yield chain(self.world, self.cylPosition, self.slide, self.piston, self.wrist)
        yield connect(self.wrist.frame_b, self.connectingRod.frame_a)
        yield chain(self.slide.support, self.gasForce, self.slide.axis)


def test_engine_with_one_cylinder():
    compare(LOOPS + "Engine1b_analytic", Engine())


class Cylinder(Component):
    """A cylinder, its piston, its rod and its part of the crankshaft; angles in degrees."""

    inclination: float = structural("angle of the cylinder")
    offset: float = structural("angle of the crank")
    cylinder_a, cylinder_b, crank_a, crank_b = Frame(), Frame(), Frame(), Frame()
    mid, crank, mounting = (FixedTranslation(r=r) for r in ((0.09, 0.05, 0), (0.14, 0, 0), (0.14, 0, 0)))
    wrist, slide = RevolutePlanarLoopConstraint(n=X), Prismatic(n=DOWN, use_axis_flange=True)
    connectingRod = BodyShape(r=(0, 0.175, 0), r_CM=(0, 0.0875, 0), m=1, I=np.diag([0.006, 0.0005, 0.006]))
    piston = BodyShape(r=(0, 0.1, 0), r_CM=(0, 0.05, 0), m=6, I=np.diag([0.0088, 0.0076, 0.0088]))
    top, gasForce = FixedTranslation(r=(0, 0.42, 0)), GasForce(L=0.195, d=0.1)

    @part
    def cylinderInclination(self):
        return FixedRotation(r=(0.09, 0, 0), n=X, angle=np.deg2rad(self.inclination))

    @part
    def crankAngle(self):
        return FixedRotation(n=X, angle=np.deg2rad(self.offset))

    @part
    def pin(self):
        return Revolute(n=X, phi=guess(np.deg2rad(self.inclination - self.offset)))

    def connections(self):
        yield chain(self.crank_a, self.crank, self.crank_b)
        yield chain(self.crank_a, self.crankAngle, self.mid, self.pin, self.connectingRod, self.wrist)
        yield chain(self.cylinder_a, self.mounting, self.cylinder_b)
        yield chain(self.cylinder_a, self.cylinderInclination, self.top, self.slide, self.piston.frame_b)
        yield connect(self.wrist.frame_b, self.piston.frame_a)
        yield chain(self.slide.support, self.gasForce, self.slide.axis)


class EngineV6(Model):
    """Six cylinders; the torque of the engine passes a filter of critical damping."""

    world, bearing = World(), Revolute(n=X, use_axis_flange=True)
    crank = Body(m=180, r_CM=(0.3, 0, 0), I=np.diag([0.1, 1e-5, 1e-5]))
    cylinders = (
        Cylinder(inclination=-30, offset=-30),
        Cylinder(inclination=30, offset=90),
        Cylinder(inclination=-30, offset=210),
        Cylinder(inclination=30, offset=210),
        Cylinder(inclination=-30, offset=90),
        Cylinder(inclination=30, offset=-30),
    )
    sensor, load = TorqueSensor(), Inertia(J=1, phi=fixed(0), w=fixed(10))
    load2 = QuadraticSpeedDependentTorque(tau_nominal=-100, w_nominal=200)
    f: Scalar = parameter("frequency of the filter", unit="Hz", default=5)
    x1: Scalar = variable("first state of the filter", unit="N.m")
    x2: Scalar = variable("second state of the filter", unit="N.m")

    def connections(self):
        yield chain(self.world, self.bearing, self.crank)
        crank, place = self.bearing.frame_b, self.bearing.frame_a
        for cylinder in self.cylinders:
            yield connect(crank, cylinder.crank_a)
            yield connect(place, cylinder.cylinder_a)
            crank, place = cylinder.crank_b, cylinder.cylinder_b
        yield chain(self.bearing.axis, self.sensor, self.load, self.load2.flange)

    def equations(self):
        w = 2 * pi * self.f / sqrt(sqrt(2) - 1)
        yield der(self.x1) == w * (self.sensor.tau - self.x1)
        yield der(self.x2) == w * (self.x1 - self.x2)

    def initial_equations(self):
        yield der(self.x1) == 0
        yield der(self.x2) == 0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:crank .*principal moment")
def test_engine_with_six_cylinders():
    names = {"filter.x[1]": "x1", "filter.x[2]": "x2"}
    compare(LOOPS + "EngineV6_analytic", EngineV6(), names, run=1e-6, intervals=400)
