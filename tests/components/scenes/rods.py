"""Parts of one-dimensional translation, each in a scene."""

from __future__ import annotations

import numpy as np

from acausal import chain, connect, cos, fixed, part, sin, structural, time
from components import Body, Prismatic, rotational
from components import translational as t
from tests.components.scenes.scene import OnSpherical


class Rail(OnSpherical):
    """A body slides on one that turns; its drive rod is connected."""

    starts = structural("whether the joint has values at the start", default=True)
    base = Body(m=2.0, I=np.diag([0.1, 0.2, 0.15]))

    @part
    def slide(self):
        start = {"s": fixed(0.3), "v": fixed(0.5)} if self.starts else {}
        return Prismatic(n=(1, 2, 2), use_axis_flange=True, **start)

    def graph(self):
        yield from self.path(self.joint, self.slide)
        yield connect(self.joint.frame_b, self.base.frame_a)
        yield from self.drive()

    def drive(self):
        yield connect(self.slide.axis, self.through(self.it)[0])


class WithMass(Rail):
    """What stands between the joint and a mass."""

    mass = t.Mass(m=0.8, s=fixed(0.1), v=fixed(-1.0))

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.slide.axis, first)
        yield connect(second, self.mass.flange_a)


class OnRodSpring(WithMass):
    @part
    def it(self):
        return t.Spring(c=80.0, s_rel0=0.1 if self.turned else -0.1)


class OnRodDamper(WithMass):
    it = t.Damper(d=3.0)


class OnRodSpringDamper(WithMass):
    @part
    def it(self):
        return t.SpringDamper(c=80.0, d=3.0, s_rel0=0.1 if self.turned else -0.1)


class OnRodElastoGap(WithMass):
    """A stop between the joint and the mass, which comes near; the same, turned round, acts beyond a distance."""

    mass = t.Mass(m=0.8, s=fixed(0.5), v=fixed(-3.0))
    it = t.ElastoGap(c=2e3, d=30.0, s_rel0=0.05, n=1.5, s_ref=0.1)

    def drive(self):
        yield chain(self.slide.axis, self.it, self.mass)


class OnRodMass(Rail):
    it = t.Mass(m=0.5, L=0.1)
    push = t.Force(f=20 * sin(3 * time))

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.slide.axis, first)
        yield connect(second, self.push.flange)


class OnRodRod(WithMass):
    """The mass moves with the joint."""

    mass = t.Mass(m=0.8)
    it = t.Rod(L=0.2)


class OnRodFixed(Rail):
    it = t.Fixed(s0=0.2)
    spring = t.Spring(c=80.0)

    def drive(self):
        yield chain(self.slide.axis, self.spring, self.it.flange)


class OnRodForce(Rail):
    it = t.Force(f=20 * sin(3 * time), use_support=True)

    def drive(self):
        yield connect(self.slide.axis, self.it.flange)
        yield connect(self.slide.support, self.it.support)


class OnRodForce2(WithMass):
    @part
    def it(self):
        return t.Force2(f=(-20 if self.turned else 20) * cos(3 * time))


class OnRodConstantForce(Rail):
    it = t.ConstantForce(f_constant=8.0)


class OnRodForceStep(Rail):
    it = t.ForceStep(step_force=8.0, offset_force=-2.0, start_time=0.2)


class OnRodSignForce(Rail):
    it = t.SignForce(f_nominal=-3.0, v0=0.3, reg="sine")


class OnRodLinearForce(Rail):
    it = t.LinearSpeedDependentForce(f_nominal=-3.0, v_nominal=0.7, force_direction=False)


class OnRodQuadraticForce(Rail):
    it = t.QuadraticSpeedDependentForce(f_nominal=-3.0, v_nominal=0.7, force_direction=False)


class OnRodInverseForce(Rail):
    it = t.InverseSpeedDependentForce(f_nominal=4.0, v_nominal=0.7, v0=0.3)


class Prescribed(Rail):
    """A drive that prescribes the motion, and a mass on a spring that answers."""

    starts = structural("whether the joint has values at the start", default=False)
    spring = t.Spring(c=80.0)
    mass = t.Mass(m=0.8, s=fixed(0.1), v=fixed(-1.0))

    def drive(self):
        yield from super().drive()
        yield chain(self.slide.axis, self.spring, self.mass)


class OnRodPosition(Prescribed):
    it = t.Position(s_ref=0.3 + 0.1 * sin(3 * time))


class OnRodMove(Prescribed):
    it = t.Move(u=(0.3 + 0.1 * sin(3 * time), 0.3 * cos(3 * time), -0.9 * sin(3 * time)))


class OnRodPositionToForce(Prescribed):
    it = t.GeneralPositionToForceAdaptor(
        p=0.3 + 0.1 * sin(3 * time), pder=0.3 * cos(3 * time), pder2=-0.9 * sin(3 * time)
    )


class OnRodForceToPosition(Rail):
    it = t.GeneralForceToPositionAdaptor(f=20 * cos(3 * time))


class OnRodSpeed(Prescribed):
    it = t.Speed(v_ref=0.5 * cos(3 * time), s=fixed(0.3))


class OnRodConstantSpeed(Prescribed):
    it = t.ConstantSpeed(v_fixed=0.4, s=fixed(0.3))


class OnRodAccelerate(Prescribed):
    it = t.Accelerate(a_ref=2 * cos(5 * time), s=fixed(0.3), v=fixed(0.2))


class Measured(OnRodFixed):
    """The joint on a spring, and a sensor at its drive rod."""

    it = None
    wall = t.Fixed(s0=0.2)

    def drive(self):
        yield chain(self.slide.axis, self.spring, self.wall.flange)
        yield connect(self.slide.axis, self.it.flange)


class OnRodPositionSensor(Measured):
    it = t.PositionSensor()


class OnRodSpeedSensor(Measured):
    it = t.SpeedSensor()


class OnRodAccSensor(Measured):
    it = t.AccSensor()


class Between(WithMass):
    """A spring between the joint and the mass, and a sensor of their distance."""

    spring = t.Spring(c=80.0)

    def drive(self):
        yield from super().drive()
        yield chain(self.slide.axis, self.spring, self.mass)


class OnRodRelativeStates(Between):
    it = t.RelativeStates()


class OnRodRelPositionSensor(Between):
    it = t.RelPositionSensor()


class OnRodRelSpeedSensor(Between):
    it = t.RelSpeedSensor()


class OnRodRelAccSensor(Between):
    it = t.RelAccSensor()


class Cut(WithMass):
    """A sensor where a spring is joined to the drive rod."""

    spring = t.Spring(c=80.0)

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.slide.axis, first)
        yield connect(second, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange_a)


class OnRodForceSensor(Cut):
    it = t.ForceSensor()


class OnRodPowerSensor(Cut):
    it = t.PowerSensor()


class OnRodMultiSensor(Cut):
    it = t.MultiSensor()


class OnRodEddyCurrentForce(Rail):
    it = t.EddyCurrentForce(f_nominal=5.0, v_nominal=0.4)


class OnRodRollingResistance(Rail):
    it = t.RollingResistance(f_weight=80.0, cr_constant=0.05, inclination=0.2 * sin(time), v0=0.3, reg="linear")


class OnRodVehicle(Rail):
    """The vehicle is pulled by the joint, and drives a rotor on a shaft."""

    it = t.Vehicle(
        m=3.0, J=0.02, R=0.2, A=0.8, Cd=0.9, v_wind_constant=-4.0, v_reg=0.05, inclination=0.3 * sin(5 * time)
    )
    rotor, shaft = rotational.Inertia(J=0.01, phi=fixed(1.5), w=fixed(1.0)), rotational.Spring(c=2.0)

    def drive(self):
        yield connect(self.slide.axis, self.it.flange_t)
        yield chain(self.it.flange_r, self.shaft, self.rotor)


class OnRodInitializeFlange(WithMass):
    """The start of the mass is given where it is measured."""

    mass = t.Mass(m=0.8)
    it = t.InitializeFlange(s_start=0.1, v_start=-1.0, use_a_start=False)
    spring = t.Spring(c=80.0)

    def drive(self):
        yield chain(self.slide.axis, self.spring, self.mass)
        yield connect(self.mass.flange_b, self.it.flange)
