"""Gears and what else of drives has a housing or backlash, each in a scene."""

from __future__ import annotations

from acausal import chain, connect, cos, fixed, part, time
from components import rotational as r
from components import translational as t
from tests.components.scenes.shafts import Prescribed, Shaft, WithRotor


class Geared(Shaft):
    """The joint drives a rotor through `it`; the housing of `it` hangs on a spring."""

    rotor = r.Inertia(J=0.05)
    housing = r.Inertia(J=0.2, phi=fixed(0.0), w=fixed(0.0))
    mounting = r.Spring(c=30.0)
    ground = r.Fixed()

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.joint.axis, first)
        yield connect(second, self.rotor.flange_a)
        yield chain(self.ground.flange, self.mounting, self.housing)
        yield connect(self.housing.flange_a, self.it.support)


class OnIdealGear(Geared):
    @part
    def it(self):
        return r.IdealGear(ratio=-0.5 if self.turned else -2.0, use_support=True)


class OnIdealPlanetary(Shaft):
    """The joint turns the sun; the carrier and the ring turn rotors, the ring against a spring."""

    it = r.IdealPlanetary(ratio=2.5)
    rotor, wheel = r.Inertia(J=0.05), r.Inertia(J=0.1, phi=fixed(0.0), w=fixed(1.0))
    spring, ground = r.Spring(c=30.0), r.Fixed()

    def drive(self):
        yield connect(self.joint.axis, self.it.sun)
        yield connect(self.it.carrier, self.rotor.flange_a)
        yield chain(self.it.ring, self.wheel, self.spring, self.ground.flange)


class ToRod(Shaft):
    """The joint moves a mass on a spring; both housings stand on inertias on springs."""

    mass, spring, wall = t.Mass(m=2.0), t.Spring(c=50.0), t.Fixed()
    housing, mounting = r.Inertia(J=0.2, phi=fixed(0.0), w=fixed(0.0)), r.Spring(c=30.0)
    bed, bolt = t.Mass(m=5.0, s=fixed(0.0), v=fixed(0.0)), t.Spring(c=900.0)
    ground = r.Fixed()

    def drive(self):
        yield connect(self.joint.axis, self.it.flange_r)
        yield chain(self.it.flange_t, self.mass, self.spring, self.wall.flange)
        yield chain(self.it.support_r, self.housing, self.mounting, self.ground.flange)
        yield chain(self.it.support_t, self.bed, self.bolt, self.wall.flange)


class OnGearR2T(ToRod):
    it = t.IdealGearR2T(ratio=8.0, use_support_r=True, use_support_t=True)


class OnRollingWheel(ToRod):
    it = t.IdealRollingWheel(radius=0.12, use_support_r=True, use_support_t=True)


class OnBacklash(WithRotor):
    """The rotor passes the backlash and comes back."""

    rotor = r.Inertia(J=0.05, phi=fixed(0.3), w=fixed(6.0))

    @part
    def it(self):
        return r.ElastoBacklash(c=300.0, d=0.5, b=0.1, phi_rel0=0.1 if self.turned else -0.1)


class OnBacklash2(OnBacklash):
    @part
    def it(self):
        return r.ElastoBacklash2(c=300.0, d=0.5, b=0.1, phi_rel0=0.1 if self.turned else -0.1)


class OnShaftTorque2(WithRotor):
    @part
    def it(self):
        return r.Torque2(tau=(-1 if self.turned else 1) * cos(3 * time))


class OnConstantTorque(Shaft):
    it = r.ConstantTorque(tau_constant=1.0)


class OnTorqueStep(Shaft):
    it = r.TorqueStep(step_torque=1.0, offset_torque=-0.2, start_time=0.2)


class OnSignTorque(Shaft):
    it = r.SignTorque(tau_nominal=-0.4, w0=1.0, reg="cosine")


class OnLinearTorque(Shaft):
    it = r.LinearSpeedDependentTorque(tau_nominal=-0.4, w_nominal=2.0, torque_direction=False)


class OnQuadraticTorque(Shaft):
    it = r.QuadraticSpeedDependentTorque(tau_nominal=-0.4, w_nominal=2.0, torque_direction=False)


class OnInverseTorque(Shaft):
    it = r.InverseSpeedDependentTorque(tau_nominal=0.5, w_nominal=2.0, w0=1.0)


class OnConstantSpeed(Prescribed):
    it = r.ConstantSpeed(w_fixed=2.0, phi=fixed(0.4))


class OnAccelerate(Prescribed):
    it = r.Accelerate(a_ref=5 * cos(3 * time), phi=fixed(0.4), w=fixed(1.0))


class Measured(Shaft):
    """The joint on a spring, and a sensor at its drive."""

    spring, wall = r.Spring(c=8.0), r.Fixed()

    def drive(self):
        yield chain(self.joint.axis, self.spring, self.wall.flange)
        yield connect(self.joint.axis, self.it.flange)


class OnAngleSensor(Measured):
    it = r.AngleSensor()


class OnSpeedSensor(Measured):
    it = r.SpeedSensor()


class OnAccSensor(Measured):
    it = r.AccSensor()


class Between(WithRotor):
    spring = r.Spring(c=8.0)

    def drive(self):
        yield from super().drive()
        yield chain(self.joint.axis, self.spring, self.rotor)


class OnRelativeStates(Between):
    it = r.RelativeStates()


class OnRelAngleSensor(Between):
    it = r.RelAngleSensor()


class OnRelSpeedSensor(Between):
    it = r.RelSpeedSensor()


class OnRelAccSensor(Between):
    it = r.RelAccSensor()


class Cut(WithRotor):
    spring = r.Spring(c=8.0)

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.joint.axis, first)
        yield connect(second, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.rotor.flange_a)


class OnTorqueSensor(Cut):
    it = r.TorqueSensor()


class OnPowerSensor(Cut):
    it = r.PowerSensor()


class OnMultiSensor(Cut):
    it = r.MultiSensor()


class OnDisc(Cut):
    @part
    def it(self):
        return r.Disc(delta_phi=-0.3 if self.turned else 0.3)


class OnEddyCurrentTorque(Shaft):
    it = r.EddyCurrentTorque(tau_nominal=0.5, w_nominal=2.0)


class OnInitializeFlange(WithRotor):
    rotor = r.Inertia(J=0.05)
    it = r.InitializeFlange(phi_start=0.1, w_start=-1.0, use_a_start=False)
    spring = r.Spring(c=8.0)

    def drive(self):
        yield chain(self.joint.axis, self.spring, self.rotor)
        yield connect(self.rotor.flange_b, self.it.flange)
