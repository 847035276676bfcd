"""Small scenes with events: a sampled controller, stick-slip, a drive with clutches, a ball that bounces."""

from __future__ import annotations

from acausal import (
    Model,
    Scalar,
    chain,
    connect,
    der,
    discrete,
    fixed,
    output,
    parameter,
    piecewise,
    quantity,
    reinit,
    time,
    variable,
    when,
)
from components import Body, Revolute, World
from components.rotational import Clutch, Fixed, Friction, Inertia, Speed, Spring, SpringDamper, Torque


class SampledPendulum(Model):
    """Pendulum of 1 kg and 1 m that a sampled PD controller lifts from below to 1 rad and holds there."""

    stop_time = 2.0
    period: Scalar = parameter("time between two samples", unit="s", default=1e-3)
    k_p: Scalar = parameter("gain of the angle", unit="N.m/rad", default=60)
    k_d: Scalar = parameter("gain of the speed", unit="N.m.s/rad", default=12)
    target: Scalar = parameter("angle from below", unit="rad", default=1)
    torque: Scalar = discrete("torque since the last sample", unit="N.m")
    due: Scalar = discrete("time of the next sample", unit="s")
    world, joint = World(g=9.81, n=(1, 0, 0)), Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
    bob, motor = Body(m=1, r_CM=(1, 0, 0)), Torque()
    angle: Scalar = output("angle from below", unit="rad")

    def connections(self):
        yield chain(self.world, self.joint, self.bob)
        yield connect(self.motor.flange, self.joint.axis)

    def equations(self):
        control = self.k_p * (self.target - self.joint.phi) - self.k_d * self.joint.w
        yield when(
            time >= self.due, reinit(self.torque, control), reinit(self.due, self.due + self.period), at_start=True
        )
        yield self.motor.tau == self.torque
        yield self.angle == self.joint.phi


class StickSlip(Model):
    """Wheel on a moving belt, held by a spring: it sticks to the belt until the spring tears it off, and slips back.

    Speeds are those of the belt over the radius of the wheel. The spring is as far stretched at the start as sliding
    friction would hold it.
    """

    stop_time = 10.0
    speed: Scalar = parameter("speed of the belt", unit="rad/s", default=1)
    tau_sliding: Scalar = parameter("friction of slipping", unit="N.m", default=4)
    tau_static: Scalar = parameter("greatest friction of sticking", unit="N.m", default=6)
    c: Scalar = parameter("stiffness of the spring", unit="N.m/rad", default=10)
    J: Scalar = parameter("moment of inertia", unit="kg.m2", default=0.1)
    belt, wall = Speed(w_ref=speed), Fixed()
    contact, spring = Friction(tau_sliding=tau_sliding, tau_static=tau_static), Spring(c=c)
    wheel = Inertia(J=J, phi=fixed(tau_sliding / c), w=fixed(speed))
    angle: Scalar = output("angle of the wheel", unit="rad")

    def connections(self):
        yield chain(self.belt.flange, self.contact, self.wheel, self.spring, self.wall.flange)

    def equations(self):
        yield self.angle == self.wheel.phi

    def initial_equations(self):
        yield self.belt.phi == 0


class Drive(Model):
    """Motor that two clutches in turn couple to two loads; each slips, locks, and is opened again."""

    stop_time = 4.0
    motor, shaft = Inertia(J=0.05, phi=fixed(0), w=fixed(0)), SpringDamper(c=400, d=0.5)
    hub, load = Inertia(J=0.02, phi=fixed(0), w=fixed(0)), Inertia(J=0.2, phi=fixed(0), w=fixed(0))
    source, clutch = Torque(), Clutch(tau_max=30, f_normalized=piecewise((0, time < 0.5), (1, time < 2.5), 0))
    brake, housing = Friction(tau_sliding=10, tau_static=15), Fixed()
    motor_speed: Scalar = output("speed of the motor", unit="rad/s")
    load_speed: Scalar = output("speed of the load", unit="rad/s")

    def connections(self):
        yield chain(self.source.flange, self.motor, self.shaft, self.hub, self.clutch, self.load)
        yield chain(self.housing.flange, self.brake, self.load.flange_b)

    def equations(self):
        w = self.motor.w
        yield self.source.tau == piecewise((0, time >= 2), (20, w < 60), quantity(1200, "W") / w)
        yield self.motor_speed == w
        yield self.load_speed == self.load.w


class Ball(Model):
    """Ball that bounces, each time a little less high."""

    stop_time = 7.8
    e: Scalar = parameter("ratio of the speeds after and before an impact", unit="1", default=0.9)
    g: Scalar = parameter("acceleration of gravity", unit="m/s2", default=9.81)
    h: Scalar = variable("height", unit="m", start=1, fixed=True)
    v: Scalar = variable("speed", unit="m/s", start=0, fixed=True)
    height: Scalar = output("height", unit="m")

    def equations(self):
        yield self.v == der(self.h)
        yield der(self.v) == -self.g
        yield self.height == self.h
        yield when(self.h < 0, reinit(self.v, -self.e * self.v))

    def stored_energy(self):
        return self.g * self.h + self.v**2 / 2
