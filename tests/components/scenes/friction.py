"""Brakes, clutches and other parts with dry friction, each in a scene."""

from __future__ import annotations

from acausal import chain, connect, fixed, part, sin, time
from components import rotational as r
from components import translational as t
from tests.components.scenes.gears import Geared
from tests.components.scenes.rods import Rail
from tests.components.scenes.shafts import WithRotor

LOAD = ((0.0, 0.05), (2.0, 0.03), (8.0, 0.06))  # over the speed, as of a lubricated bearing


class OnShaftFriction(WithRotor):
    it = r.Friction(tau_sliding=0.05, tau_static=0.1)


class OnShaftClutch(WithRotor):
    it = r.Clutch(mu_pos=((0.0, 0.5), (3.0, 0.4)), cgeo=0.2, fn_max=2.0, peak=1.1, f_normalized=0.5)


class OnOneWayClutch(WithRotor):
    """The rotor overruns the joint; the same, turned round, is another part."""

    rotor = r.Inertia(J=0.05, phi=fixed(0.1), w=fixed(5.0))
    it = r.OneWayClutch(tau_max=0.1, f_normalized=0.5)

    def drive(self):
        yield chain(self.joint.axis, self.it, self.rotor)


class Housed(Geared):
    """A shaft from the joint to a rotor, in a housing on a spring."""

    rotor = r.Inertia(J=0.05)


class OnBearingFriction(Housed):
    it = r.BearingFriction(tau_pos=LOAD, peak=1.5, use_support=True)


class OnBrake(Housed):
    it = r.Brake(tau_max=0.2, f_normalized=sin(3 * time), use_support=True)


class OnLossyGear(Geared):
    rotor = r.Inertia(J=0.05)

    @part
    def it(self):
        table, ratio = (0, 0.8, 0.7, 0.02, 0.03), 2.0
        if self.turned:
            _, eta_1, eta_2, bearing_1, bearing_2 = table
            table, ratio = (0, eta_2, eta_1, ratio * bearing_2 * eta_2, ratio * bearing_1 / eta_1), 1 / ratio
        return r.LossyGear(ratio=ratio, loss_table=[table], use_support=True)


class OnGearbox(Geared):
    """The housing stands still, and the gear comes from the joint."""

    rotor = r.Inertia(J=0.05, phi=fixed(0.2), w=fixed(1.0))
    it = r.Gearbox(ratio=2.0, loss_table=[(0, 0.8, 0.7, 0.02, 0.03)], c=300.0, d=0.5, b=0.02, use_support=True)

    def drive(self):
        yield chain(self.joint.axis, self.it, self.rotor)
        yield chain(self.ground.flange, self.mounting, self.housing)
        yield connect(self.housing.flange_a, self.it.support)


class Sliding(Rail):
    """A rod from the joint to a mass, in a housing on a spring."""

    mass = t.Mass(m=0.8)
    bed, bolt, wall = t.Mass(m=5.0, s=fixed(0.0), v=fixed(0.0)), t.Spring(c=900.0), t.Fixed()

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.slide.axis, first)
        yield connect(second, self.mass.flange_a)
        yield chain(self.it.support, self.bed, self.bolt, self.wall.flange)


class OnSupportFriction(Sliding):
    it = t.SupportFriction(f_pos=((0.0, 1.0), (0.5, 0.7), (2.0, 1.2)), peak=1.2, use_support=True)


class OnRodBrake(Sliding):
    it = t.Brake(fn_max=8.0, f_normalized=sin(3 * time), use_support=True)


class OnMassWithStopAndFriction(Rail):
    """The mass does not reach its stops: what a stop takes from it is no power."""

    push = t.Force(f=20 * sin(3 * time))

    @part
    def it(self):
        return t.MassWithStopAndFriction(L=0.1, m=0.5, F_prop=0.4, F_Coulomb=1.0, F_Stribeck=2.0, fexp=2.0)

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.slide.axis, first)
        yield connect(second, self.push.flange)
