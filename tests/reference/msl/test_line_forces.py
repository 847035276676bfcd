"""Struts as line forces and as joints, and forces that are differentiated: ModelicaTest.MultiBody.Forces."""

from __future__ import annotations

import numpy as np

from acausal import Model, Vector3, chain, connect, der, fixed, sine, variable
from components import (
    Body,
    BodyBox,
    FixedTranslation,
    LineForceWithMass,
    LineForceWithTwoMasses,
    Revolute,
    Spring,
    SpringDamperParallel,
    SpringDamperSeries,
    World,
    WorldForceAndTorque,
)
from components import Damper as LineDamper
from components.assemblies import JointUPS
from components.sensors import CutForce
from components.thermal import Convection, FixedTemperature
from components.translational import Damper, Fixed, Mass, Position
from tests.reference.msl.gas_force import GasForce
from tests.reference.msl.published import compare

FORCES = "ModelicaTest.MultiBody.Forces."
AXIS = np.array([0.7, 1.2, 0])


def hinge():
    return Revolute(phi=fixed(0), w=fixed(0))


class Struts(Model):
    """Two doors with equal struts, one a chain of joints, the other a line force, each with a damper."""

    world = World()
    rod1, rod2 = FixedTranslation(r=(0, -0.9, 0)), FixedTranslation(r=(0, 0.3, 0))
    rod3, rod4 = FixedTranslation(r=(0, -0.9, 0.3)), FixedTranslation(r=(0, 0.3, 0.3))
    revolute1, revolute2 = hinge(), hinge()
    bodyBox1, bodyBox2 = BodyBox(r=(0.7, 0, 0)), BodyBox(r=(0.7, 0, 0))
    jointUPS = JointUPS(n_axis_ia=AXIS, use_axis_flange=True)
    damper1, damper2 = Damper(d=3), Damper(d=3)
    line = LineForceWithMass()

    def connections(self):
        yield chain(self.world, self.rod2, self.revolute1, self.bodyBox1, self.jointUPS.frame_b)
        yield chain(self.world, self.rod1, self.jointUPS.frame_a)
        yield chain(self.jointUPS.support, self.damper1, self.jointUPS.axis)
        yield chain(self.world, self.rod4, self.revolute2, self.bodyBox2, self.line.frame_b)
        yield chain(self.rod4.frame_a, self.rod3, self.line.frame_a)
        yield chain(self.line.flange_a, self.damper2, self.line.flange_b)


def test_line_force_with_mass():
    compare(FORCES + "LineForceWithMass", Struts())


class HeavyStruts(Struts):
    """The struts carry two masses."""

    line = LineForceWithTwoMasses(m_a=1, m_b=1, L_a=0.2, L_b=0.2)
    body1 = Body(m=1, r_CM=0.2 * AXIS / np.linalg.norm(AXIS))
    body2 = Body(m=1, r_CM=-0.2 * AXIS / np.linalg.norm(AXIS))

    def connections(self):
        yield from super().connections()
        yield connect(self.jointUPS.frame_ia, self.body1.frame_a)
        yield connect(self.jointUPS.frame_ib, self.body2.frame_a)


def test_line_force_with_two_masses():
    compare(FORCES + "LineForceWithTwoMasses", HeavyStruts())


class Differentiated(Model):
    """The cut force in a loaded pendulum is differentiated twice."""

    world, rev, body = World(), hinge(), BodyBox(r=(1, 0, 0))
    cutForce = CutForce()
    load = WorldForceAndTorque(force=(sine(f=1),) * 3, torque=(sine(f=1),) * 3, resolve_in_frame="frame_b")
    rate: Vector3 = variable("der(force)", unit="N/s")
    rate2: Vector3 = variable("der(rate)", unit="N/s2")

    def connections(self):
        yield chain(self.world, self.rev, self.body)
        yield connect(self.body.frame_b, self.cutForce.frame_b)
        yield connect(self.cutForce.frame_a, self.load.frame_b)

    def equations(self):
        yield self.rate == der(self.cutForce.force)
        yield self.rate2 == der(self.rate)


def test_differentiation_of_forces():
    compare(FORCES + "DifferentiationOfForces", Differentiated())


class Cylinder(Model):
    """The piston follows a sine."""

    fixed, mass = Fixed(), Mass(m=1)
    gasForce = GasForce(L=0.2, d=0.1, k0=0.01, k1=1.1, k=1.08)
    position = Position(s_ref=sine(amplitude=0.0999999, f=1, offset=0.1))

    def connections(self):
        yield chain(self.fixed.flange, self.gasForce, self.mass, self.position.flange)


AIR = 287.051  # gas constant of the published density, J/(kg.K)


def test_engine_gas_force():
    names = {"gasForce.dens": lambda r: r["gasForce.press"] / (AIR * r["gasForce.T"])}
    compare(FORCES + "EngineGasForce", Cylinder(), names)


def hanging(x):
    return Body(
        m=1,
        r_CM=(0, -0.2, 0),
        I=0.1 * np.eye(3),
        r_0=fixed((x, -0.2, 0)),
        v_0=fixed((0, 0, 0)),
        angles_fixed=True,
        w_a=fixed((0, 0, 0.034906585039887)),
    )


class HeatLosses(Model):
    """Bodies on springs and dampers, whose losses leave by convection."""

    world, bar1, bar2, bar3 = World(), *(FixedTranslation(r=(0.3, 0, 0)) for _ in range(3))
    body1, body2, body3 = hanging(0.3), hanging(0.6), hanging(0.9)
    spring1, damper1 = Spring(c=30, s_unstretched=0.1), LineDamper(d=2, use_heat_port=True)
    springDamper = SpringDamperParallel(c=30, d=2, s_unstretched=0.1, use_heat_port=True)
    springDamperSeries = SpringDamperSeries(c=30, d=2, s_unstretched=0.1, use_heat_port=True, s_damper=fixed(0))
    spring, convection, ambient = Spring(c=30, s_unstretched=0.2), Convection(Gc=20), FixedTemperature(T=298.15)

    def connections(self):
        yield chain(self.world, self.bar1, self.bar2, self.bar3)
        for bar, force, body in (
            (self.bar1, self.spring1, self.body1),
            (self.bar1, self.damper1, self.body1),
            (self.bar2, self.springDamper, self.body2),
            (self.bar3, self.springDamperSeries, self.body3),
            (self.bar3, self.spring, self.body3),
        ):
            yield chain(bar, force, body)
        for part in (self.damper1, self.springDamper, self.springDamperSeries):
            yield connect(part.heat_port, self.convection.solid)
        yield connect(self.convection.fluid, self.ambient.port)


def test_heat_losses():
    compare("Modelica.Mechanics.MultiBody.Examples.Elementary.HeatLosses", HeatLosses())
