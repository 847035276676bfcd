"""Machines with dry friction of Modelica.Mechanics and ModelicaTest."""

from __future__ import annotations

from math import exp, pi

import numpy as np

from acausal import Model, chain, connect, fixed, pulse, ramp, sine, step
from components import translational as tr
from components.rotational import (
    BearingFriction,
    Brake,
    Clutch,
    ConstantTorque,
    Fixed,
    IdealGear,
    IdealPlanetary,
    Inertia,
    LossyGear,
    OneWayClutch,
    QuadraticSpeedDependentTorque,
    SpringDamper,
    Torque,
    TorqueStep,
)
from components.thermal import Convection, FixedTemperature
from tests.reference.msl.published import compare, published

ROTATIONAL = "Modelica.Mechanics.Rotational.Examples."
TRANSLATIONAL = "Modelica.Mechanics.Translational.Examples."
GUIDE = "ModelicaTest.Rotational.ForUsersGuide."


def agree(name, model, open_=(), left_out=(), **settings):
    """Compare all but what is left out and the flags of the first instant of sliding.

    The mode of a brake or clutch is 2 where it is open.
    """
    flags = [v for v in published()[name] if v.endswith(("startForward", "startBackward", "stuck"))]
    names = {f"{part}.mode": lambda r, p=part: np.where(r[f"{p}.fn"] > 0, r[f"{p}.mode"], 2) for part in open_}
    compare(name, model, names, (*flags, *left_out), most_left_out=len(flags) + len(left_out), **settings)


def turning(J, w=0.0):
    return Inertia(J=J, phi=fixed(0), w=fixed(w))


class CoupledClutches(Model):
    torque, J1, J2, J3, J4 = Torque(tau=sine(amplitude=10, f=5)), turning(1, 10), turning(1), turning(1), turning(1)
    clutch1 = Clutch(peak=1.1, fn_max=20, f_normalized=sine(amplitude=1, f=0.2, phase=pi / 2))
    clutch2 = Clutch(peak=1.1, fn_max=20, f_normalized=step(height=1, start_time=0.4))
    clutch3 = Clutch(peak=1.1, fn_max=20, f_normalized=step(height=1, start_time=0.9))

    def connections(self):
        yield chain(self.torque.flange, self.J1, self.clutch1, self.J2, self.clutch2, self.J3, self.clutch3, self.J4)


def test_coupled_clutches():
    agree(ROTATIONAL + "CoupledClutches", CoupledClutches(), ("clutch1", "clutch2", "clutch3"))


class Friction(Model):
    torque = Torque(tau=sine(amplitude=200, f=50 / pi) * step(height=-1, offset=1, start_time=0.5))
    inertia3, inertia2, inertia1 = turning(1, 100), turning(0.05, 90), turning(1, 90)
    clutch, spring = Clutch(fn_max=160, f_normalized=1), SpringDamper(c=160, d=1)
    brake, ground = Brake(fn_max=1600, use_support=True, f_normalized=step(height=1, start_time=0.5)), Fixed()

    def connections(self):
        yield chain(
            self.torque.flange, self.inertia3, self.clutch, self.inertia2, self.spring, self.brake, self.inertia1
        )
        yield connect(self.brake.support, self.ground.flange)


def test_friction():
    agree(ROTATIONAL + "Friction", Friction(), ("brake", "clutch"))


class LossyGearDemo1(Model):
    torque1, torque2 = Torque(tau=sine(amplitude=10, f=1)), Torque(tau=ramp(height=5, duration=2, offset=-10))
    gear = LossyGear(ratio=2, loss_table=[(0, 0.5, 0.5, 0, 0)], use_support=True)
    Inertia1, Inertia2, ground = Inertia(J=1), turning(1.5), Fixed()

    def connections(self):
        yield chain(self.torque1.flange, self.Inertia1, self.gear, self.Inertia2, self.torque2.flange)
        yield connect(self.gear.support, self.ground.flange)


def test_lossy_gear_1():
    agree(ROTATIONAL + "LossyGearDemo1", LossyGearDemo1())


class LossyGearDemo2(LossyGearDemo1):
    bearingFriction = BearingFriction(tau_pos=[(0, 0.5), (1, 1)])

    def connections(self):
        yield from super().connections()
        yield connect(self.bearingFriction.flange_b, self.Inertia1.flange_a)


def test_lossy_gear_2():
    # Gear and bearing are on one rigid shaft: which of them sticks at rest is not determined.
    agree(ROTATIONAL + "LossyGearDemo2", LossyGearDemo2(), left_out=("gear.mode", "bearingFriction.mode"))


class LossyGearDemo3(Model):
    gear, torque2 = (
        LossyGear(ratio=1, loss_table=[(0, 0.25, 0.25, 0.625, 2.5)]),
        Torque(tau=step(height=1, start_time=0.5)),
    )
    Inertia1, Inertia2 = Inertia(J=0.001), turning(0.001, 10)

    def connections(self):
        yield chain(self.Inertia1, self.gear, self.Inertia2, self.torque2.flange)


def test_lossy_gear_3():
    agree(ROTATIONAL + "LossyGearDemo3", LossyGearDemo3())


class OneWay(Model):
    torque, inertiaIn, inertiaOut = Torque(tau=sine(amplitude=10, f=3)), turning(1, -0.5), turning(1)
    oneWayClutch = OneWayClutch(
        peak=25, fn_max=3, f_normalized=pulse(amplitude=1, width=50, period=1.3, start_time=0.3)
    )

    def connections(self):
        yield chain(self.torque.flange, self.inertiaIn, self.oneWayClutch, self.inertiaOut)


def test_one_way_clutch():
    agree(ROTATIONAL + "OneWayClutch", OneWay())


class OneWayDisengaged(OneWay):
    torque, oneWayClutch = (
        Torque(tau=sine(amplitude=10, f=2, offset=0.3)),
        OneWayClutch(peak=25, fn_max=3, f_normalized=0),
    )
    torqueLoad = ConstantTorque(tau_constant=-0.3)

    def connections(self):
        yield from super().connections()
        yield connect(self.inertiaOut.flange_b, self.torqueLoad.flange)


def test_one_way_clutch_disengaged():
    agree(ROTATIONAL + "OneWayClutchDisengaged", OneWayDisengaged())


class SimpleGearShift(Model):
    shift = ramp(height=1, start_time=2, duration=0.1)
    torqueStep, engine, load = TorqueStep(start_time=0.5, step_torque=20), Inertia(J=1), turning(10)
    idealPlanetary, drag = (
        IdealPlanetary(ratio=75 / 50),
        QuadraticSpeedDependentTorque(w_nominal=pi / 0.3, tau_nominal=-20),
    )
    clutch = Clutch(cgeo=2, fn_max=100, f_normalized=shift, phi_rel=fixed(0), w_rel=fixed(0))
    brake = Brake(cgeo=2, fn_max=100, f_normalized=1 - shift)

    def connections(self):
        gear = self.idealPlanetary
        yield chain(self.torqueStep.flange, self.engine, gear.sun)
        yield chain(gear.sun, self.clutch, gear.ring)
        yield connect(gear.ring, self.brake.flange_a)
        yield chain(gear.carrier, self.load, self.drag.flange)


def test_simple_gear_shift():
    agree(ROTATIONAL + "SimpleGearShift", SimpleGearShift(), ("clutch", "brake"))


class SupportTorque1(Model):
    torque, inertia3, gear = Torque(tau=sine(f=1)), turning(1), IdealGear(ratio=1)
    bearingFriction1, inertia4 = BearingFriction(tau_pos=1), Inertia(J=1)

    def connections(self):
        yield chain(self.torque.flange, self.inertia3, self.gear, self.bearingFriction1, self.inertia4)


def test_support_torque():
    agree(GUIDE + "SupportTorque1", SupportTorque1())


class Frictions(Model):
    torque, torque1, torque2, torque3 = (Torque(tau=sine(amplitude=10, f=1)) for _ in range(4))
    inertia, inertia1, inertia2, inertia4 = turning(1), turning(1), turning(1), turning(1)
    inertia3, inertia5, bearingFriction = Inertia(J=1), Inertia(J=1), BearingFriction(tau_pos=1)
    brake = Brake(fn_max=1, f_normalized=step(height=100, start_time=0.5))
    clutch = Clutch(fn_max=1, f_normalized=step(height=100, start_time=0.5), phi_rel=fixed(0), w_rel=fixed(0))
    oneWayClutch = OneWayClutch(
        fn_max=1, f_normalized=step(height=100, start_time=0.5), phi_rel=fixed(0), w_rel=fixed(0)
    )

    def connections(self):
        yield chain(self.torque.flange, self.inertia, self.bearingFriction)
        yield chain(self.torque1.flange, self.inertia1, self.brake)
        yield chain(self.torque2.flange, self.inertia2, self.clutch, self.inertia3)
        yield chain(self.torque3.flange, self.inertia4)
        yield chain(self.inertia5, self.oneWayClutch)
        yield connect(self.oneWayClutch.flange_b, self.inertia4.flange_b)


def test_frictions():
    agree("ModelicaTest.Rotational.TestFriction", Frictions(), ("brake", "clutch"))


class RodBrakes(Model):
    on = step(height=2, start_time=0.1)
    mass1, mass2 = (tr.Mass(m=1, s=fixed(0), v=fixed(1)) for _ in range(2))
    brake, brake1 = tr.Brake(fn_max=1, f_normalized=on), tr.Brake(fn_max=1, f_normalized=on, use_support=True)
    ground = tr.Fixed()

    def connections(self):
        yield chain(self.mass1, self.brake)
        yield chain(self.mass2, self.brake1)
        yield connect(self.brake1.support, self.ground.flange)


def test_rod_brakes():
    agree(TRANSLATIONAL + "Brake", RodBrakes(), ("brake", "brake1"))


class RodFriction(Model):
    force, force2 = (tr.Force(f=sine(amplitude=25, f=0.25)) for _ in range(2))
    stop1 = tr.MassWithStopAndFriction(L=1, m=1, F_prop=1, F_Coulomb=5, F_Stribeck=10, fexp=2, s=fixed(0), v=fixed(0))
    stop2 = tr.MassWithStopAndFriction(
        L=1, smax=0.9, smin=-0.9, F_Coulomb=3, F_Stribeck=5, m=1, F_prop=1, fexp=2, s=fixed(0), v=fixed(-5)
    )
    spring, fixed2, mass = tr.Spring(s_rel0=1, c=500), tr.Fixed(s0=-1.75), tr.Mass(m=1, L=1, s=fixed(0), v=fixed(0))
    supportFriction = tr.SupportFriction(f_pos=[(v, 5 + v + 10 * exp(-2 * v)) for v in np.linspace(0, 12, 50).tolist()])

    def connections(self):
        yield chain(self.force.flange, self.stop1)
        yield chain(self.fixed2.flange, self.spring, self.stop2)
        yield chain(self.force2.flange, self.mass, self.supportFriction)


def test_rod_friction():
    agree(TRANSLATIONAL + "Friction", RodFriction())


class HeatLosses(Model):
    force, mass1 = tr.Force(f=sine(f=1, amplitude=20)), tr.Mass(m=1, s=fixed(0), v=fixed(0), L=0.1)
    springDamper = tr.SpringDamper(s_rel=fixed(0), v_rel=fixed(0), c=100, d=10, use_heat_port=True)
    damper, elastoGap = tr.Damper(d=10, use_heat_port=True), tr.ElastoGap(c=100, d=20, s_rel0=-0.02, use_heat_port=True)
    fixed1, fixed2 = tr.Fixed(), tr.Fixed()
    mass2, supportFriction = tr.Mass(m=1, L=0.1), tr.SupportFriction(f_pos=1, use_heat_port=True)
    spring, mass3 = tr.Spring(c=100, s_rel=fixed(0)), tr.Mass(m=1, L=0.1, v=fixed(0))
    brake = tr.Brake(fn_max=10, use_heat_port=True, f_normalized=sine(amplitude=10, f=2))
    springDamper1 = tr.SpringDamper(c=10000, d=1000, use_heat_port=True, s_rel=fixed(0))
    # Jumps keep the states; those of the published run are relative ones.
    states, states1 = tr.RelativeStates(), tr.RelativeStates()
    massWithStopAndFriction = tr.MassWithStopAndFriction(
        L=0.1, m=1, F_prop=0.5, F_Coulomb=1, F_Stribeck=2, fexp=2, smin=0, smax=0.4, v=fixed(0), use_heat_port=True
    )
    convection, TAmbient = Convection(Gc=20), FixedTemperature(T=298.15)

    def connections(self):
        yield chain(self.force.flange, self.mass1, self.springDamper, self.mass2, self.supportFriction, self.spring)
        yield chain(self.spring, self.mass3, self.brake, self.springDamper1, self.massWithStopAndFriction)
        yield chain(self.mass1.flange_a, self.damper, self.fixed1.flange)
        yield chain(self.fixed2.flange, self.elastoGap, self.mass1.flange_a)
        yield connect(self.TAmbient.port, self.convection.fluid)
        yield chain(self.springDamper.flange_a, self.states, self.springDamper.flange_b)
        yield chain(self.springDamper1.flange_a, self.states1, self.springDamper1.flange_b)
        warm = self.elastoGap, self.damper, self.springDamper, self.supportFriction, self.brake, self.springDamper1
        for part in (*warm, self.massWithStopAndFriction):
            yield connect(self.convection.solid, part.heat_port)


def test_heat_losses():
    agree(TRANSLATIONAL + "HeatLosses", HeatLosses(), ("brake",))
