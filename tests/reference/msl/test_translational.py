"""Machines of Modelica.Mechanics.Translational.Examples."""

from __future__ import annotations

from acausal import Model, chain, connect, fixed, sine
from components.thermal import HeatCapacitor
from components.translational import (
    Accelerate,
    AccSensor,
    ConstantForce,
    Damper,
    EddyCurrentForce,
    ElastoGap,
    Fixed,
    Force,
    ForceSensor,
    InverseSpeedDependentForce,
    LinearSpeedDependentForce,
    Mass,
    MultiSensor,
    PositionSensor,
    QuadraticSpeedDependentForce,
    Rod,
    SignForce,
    SpeedSensor,
    Spring,
    SpringDamper,
)
from tests.reference.msl.published import compare

EXAMPLES = "Modelica.Mechanics.Translational.Examples."


class Accelerated(Model):
    accelerate, mass = Accelerate(a_ref=1, s=fixed(0), v=fixed(0)), Mass(L=1, m=1)

    def connections(self):
        yield chain(self.accelerate.flange, self.mass)


def test_accelerate():
    compare(EXAMPLES + "Accelerate", Accelerated())


def thrown():
    return Mass(m=1, L=1, s=fixed(3), v=fixed(10))


class Dampers(Model):
    mass1, mass2, mass3 = thrown(), thrown(), thrown()
    damper1, damper2, spring2 = Damper(d=25), Damper(d=25), Spring(c=1, s_rel0=1)
    springDamper3 = SpringDamper(c=1, d=25, s_rel0=1)
    wall = Fixed(s0=4.5)

    def connections(self):
        yield chain(self.mass1, self.damper1, self.wall.flange)
        yield chain(self.mass2, self.damper2, self.wall.flange)
        yield chain(self.mass2, self.spring2, self.wall.flange)
        yield chain(self.mass3, self.springDamper3, self.wall.flange)


def test_damper():
    compare(EXAMPLES + "Damper", Dampers())


class Gaps(Model):
    ground, rod1, rod2 = Fixed(), Rod(L=2), Rod(L=2)
    springDamper1, springDamper2 = SpringDamper(c=10, d=1.5, s_rel0=1), SpringDamper(c=10, d=1.5, s_rel0=1)
    elastoGap1, elastoGap2 = ElastoGap(c=10, d=1.5, s_rel0=1.5), ElastoGap(c=10, d=1.5, s_rel0=1.5)
    mass1, mass2 = Mass(m=1, s=fixed(2), v=fixed(0)), Mass(m=1, s=fixed(2), v=fixed(0))

    def connections(self):
        yield chain(self.rod1, self.ground.flange, self.rod2)
        yield chain(self.rod1.flange_a, self.springDamper1, self.mass1, self.springDamper2, self.rod2.flange_b)
        yield chain(self.rod1.flange_a, self.elastoGap1, self.mass2, self.elastoGap2, self.rod2.flange_b)


def test_elasto_gap():
    compare(EXAMPLES + "ElastoGap", Gaps())


class InitialConditions(Model):
    fixed1, s1, m1 = Fixed(s0=-1), Spring(c=1e3, s_rel0=1, s_rel=fixed(0.5)), Mass(m=1, L=1, v=fixed(0))
    sd1, m2 = SpringDamper(c=111, d=1, s_rel0=1, s_rel=fixed(1), v_rel=fixed(0)), Mass(m=1, L=2)
    fixed2, s2, m3 = Fixed(s0=1), Spring(c=1e3, s_rel0=2), Mass(m=1, L=3, s=fixed(4.5), v=fixed(0))
    sd2, m4 = SpringDamper(c=111, d=1, s_rel0=4), Mass(m=1, L=5, s=fixed(12.5), v=fixed(0))

    def connections(self):
        yield chain(self.fixed1.flange, self.s1, self.m1, self.sd1, self.m2)
        yield chain(self.fixed2.flange, self.s2, self.m3, self.sd2, self.m4)


def test_initial_conditions():
    compare(EXAMPLES + "InitialConditions", InitialConditions())


def oscillating():
    return Mass(m=1, L=1, s=fixed(-0.5), v=fixed(0))


class Oscillator(Model):
    force1, force2 = Force(f=sine(f=15.9155)), Force(f=sine(f=15.9155))
    mass1, mass2, wall = oscillating(), oscillating(), Fixed(s0=1)
    spring1, spring2, damper1 = Spring(c=1e4, s_rel0=1), Spring(c=1e4, s_rel0=1), Damper(d=10)

    def connections(self):
        yield chain(self.force1.flange, self.mass1, self.spring1, self.wall.flange)
        yield chain(self.force2.flange, self.mass2, self.spring2, self.wall.flange)
        yield chain(self.mass2, self.damper1, self.wall.flange)


def test_oscillator():
    compare(EXAMPLES + "Oscillator", Oscillator())


class Sensors(Model):
    force, mass = Force(f=sine(amplitude=10, f=4)), Mass(m=1, L=1, s=fixed(0), v=fixed(0))
    forceSensor, multiSensor = ForceSensor(), MultiSensor()
    speedSensor1, accSensor1, positionSensor1, positionSensor2 = (
        SpeedSensor(),
        AccSensor(),
        PositionSensor(),
        PositionSensor(),
    )

    def connections(self):
        yield chain(self.force.flange, self.forceSensor, self.multiSensor, self.mass, self.positionSensor2.flange)
        for sensor in (self.speedSensor1, self.accSensor1, self.positionSensor1):
            yield connect(self.mass.flange_a, sensor.flange)


def test_sensors():
    compare(EXAMPLES + "Sensors", Sensors())


def resting():
    return Mass(m=1, L=1, s=fixed(0), v=fixed(0))


class SignConvention(Model):
    mass1, mass2, mass3 = resting(), resting(), resting()
    force1, force2, force3 = Force(f=1), Force(f=1), Force(f=1)

    def connections(self):
        yield connect(self.force1.flange, self.mass1.flange_a)
        yield connect(self.force2.flange, self.mass2.flange_b)
        yield connect(self.force3.flange, self.mass3.flange_b)


def test_sign_convention():
    compare(EXAMPLES + "SignConvention", SignConvention())


class WhyArrows(Model):
    fixed1, spring1, mass1 = Fixed(s0=-1.9), Spring(c=11, s_rel0=2), Mass(m=1, L=2, s=fixed(0), v=fixed(0))
    fixed2, spring2, inertia2 = Fixed(s0=-1.9), Spring(c=11, s_rel0=2), Mass(m=1, L=2, s=fixed(0), v=fixed(0))

    def connections(self):
        yield connect(self.fixed1.flange, self.spring1.flange_a)
        yield connect(self.spring1.flange_b, self.mass1.flange_b)
        yield connect(self.fixed2.flange, self.spring2.flange_a)
        yield connect(self.spring2.flange_b, self.inertia2.flange_b)


def test_why_arrows():
    compare(EXAMPLES + "WhyArrows", WhyArrows())


def contact(s_rel0):
    return ElastoGap(c=1e6, d=250, s_rel0=s_rel0)


class PreLoad(Model):
    """A spool between two preloaded springs."""

    innerContactA, innerContactB, outerContactA, outerContactB = (contact(s) for s in (0.001, 0.001, 0.0015, 0.0015))
    spool = Mass(m=0.150, L=0.19, s=fixed(0.01475), v=fixed(0))
    springPlateA = Mass(m=0.01, L=0.002, s=fixed(-0.093), v=fixed(0))
    springPlateB = Mass(m=0.01, L=0.002, s=fixed(-0.06925), v=fixed(0))
    fixedLe, housing, spring, friction = Fixed(s0=-0.0955), Rod(L=0.0305), Spring(c=20e3, s_rel0=0.025), Damper(d=2500)
    rod1, rod2, rod3, rod4 = Rod(L=0.007), Rod(L=0.007), Rod(L=0.00575), Rod(L=0.00575)
    force = Force(f=sine(amplitude=150, f=0.01))

    def connections(self):
        yield chain(self.fixedLe.flange, self.outerContactA, self.springPlateA, self.spring, self.springPlateB)
        yield chain(self.springPlateB, self.outerContactB, self.housing.flange_b)
        yield chain(self.fixedLe.flange, self.housing)
        yield chain(self.springPlateA, self.rod1, self.innerContactA.flange_b)
        yield chain(self.fixedLe.flange, self.friction, self.rod3, self.rod4, self.innerContactB.flange_b)
        yield connect(self.innerContactA.flange_a, self.rod3.flange_a)
        yield chain(self.innerContactB.flange_a, self.rod2, self.springPlateB.flange_a)
        yield chain(self.force.flange, self.spool.flange_a)
        yield connect(self.spool.flange_a, self.rod4.flange_a)


def test_preload():
    compare(EXAMPLES + "PreLoad", PreLoad())


def braked(v=100):
    return Mass(m=1, s=fixed(0), v=fixed(v))


class Braking(Model):
    """Masses slowed down by laws of their speed."""

    mass1, mass2, mass3, mass4, mass5, mass6 = braked(), braked(), braked(), braked(), braked(20), braked()
    force1 = LinearSpeedDependentForce(f_nominal=-100, v_nominal=100)
    force2 = QuadraticSpeedDependentForce(f_nominal=-100, v_nominal=100)
    force3, force4 = ConstantForce(f_constant=-100), SignForce(f_nominal=-100, v0=1)
    force5 = EddyCurrentForce(f_nominal=100, v_nominal=10, use_heat_port=True, alpha20=3.920e-3)
    force6 = InverseSpeedDependentForce(f_nominal=-100, v_nominal=100, v0=1)
    heat = HeatCapacitor(C=1, T=fixed(293.15))

    def connections(self):
        for k in range(1, 7):
            yield connect(getattr(self, f"mass{k}").flange_b, getattr(self, f"force{k}").flange)
        yield connect(self.force5.heat_port, self.heat.port)


def test_braking():
    compare("ModelicaTest.Translational.TestBraking", Braking())
