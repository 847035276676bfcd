"""Small machines on which algebraic variables, events, energies and sizes are put to the test."""

from __future__ import annotations

import numpy as np

from acausal import Model, Scalar, chain, connect, cos, der, fixed, parameter, piecewise, time, variable
from components import Body, BodyShape, Fixed, Prismatic, Revolute, Spring, World, rotational
from components.line_force import LineForce

FREE = {"m": 1.0, "I": 0.01 * np.eye(3), "angles_fixed": True, "w_a": fixed((0, 0, 0))}


class Fall(Model):
    """A free body falls past the end of a soft spring: the length turns sharply where steps are long."""

    c: Scalar = parameter("stiffness", unit="N/m", default=1e-3)
    world = World()
    anchor = Fixed(r=(0.3, -10, 0))
    spring = Spring(c=c)
    body = Body(r_0=fixed((0, 0, 0)), v_0=fixed((0, 0, 0)), **FREE)

    def connections(self):
        yield chain(self.anchor, self.spring, self.body)


class Contact(LineForce):
    """Elastic contact of two balls: pushes where their centres are nearer than R."""

    k: Scalar = parameter("stiffness", unit="N/m", default=1e4)
    R: Scalar = parameter("distance of touching balls", unit="m", default=0.1)

    def law(self):
        yield self.f == piecewise((self.k * (self.s - self.R), self.s < self.R), 0)

    def stored_energy(self):
        return piecewise((self.k * (self.s - self.R) ** 2 / 2, self.s < self.R), 0)


class Rope(LineForce):
    """Elastic rope: pulls where it is longer than R."""

    k: Scalar = parameter("stiffness", unit="N/m", default=1e4)
    R: Scalar = parameter("length", unit="m", default=1)

    def law(self):
        yield self.f == piecewise((self.k * (self.s - self.R), self.s > self.R), 0)

    def stored_energy(self):
        return piecewise((self.k * (self.s - self.R) ** 2 / 2, self.s > self.R), 0)


class Two(Model):
    """A flying ball hits a resting one, not in its middle."""

    speed: Scalar = parameter("speed of the first ball", unit="m/s", default=1.0)
    world = World(gravity=None)
    a = Body(r_0=fixed((0, 0, 0)), v_0=fixed((speed, 0, 0)), **FREE)
    b = Body(r_0=fixed((1, 0.02, 0)), v_0=fixed((0, 0, 0)), **FREE)
    contact = Contact()

    def connections(self):
        yield connect(self.a.frame_a, self.contact.frame_a)
        yield connect(self.contact.frame_b, self.b.frame_a)


class Tether(Model):
    """A body falls into a rope."""

    world = World()
    anchor = Fixed(r=(0, 0, 0))
    body = Body(r_0=fixed((0.3, 0, 0)), v_0=fixed((0, 0, 0)), **FREE)
    rope = Rope()

    def connections(self):
        yield connect(self.anchor.frame_b, self.rope.frame_a)
        yield connect(self.rope.frame_b, self.body.frame_a)


class Axis(Model):
    """Axis of a robot: controlled motor with dry friction in its bearing, elastic gear, load."""

    motor = rotational.Inertia(J=0.0013, phi=fixed(0), w=fixed(0))
    friction = rotational.Friction(tau_sliding=0.4, tau_static=0.5)
    gear = rotational.SpringDamper(c=43.0, d=0.005)
    load = rotational.Inertia(J=0.01, phi=fixed(0), w=fixed(0))
    ground = rotational.Fixed()
    torque = rotational.Torque()
    integral: Scalar = variable("integral of the speed error", start=0, fixed=True)
    error: Scalar = variable("speed error")

    def connections(self):
        yield chain(self.motor, self.gear, self.load)
        yield connect(self.torque.flange, self.motor.flange_a)
        yield connect(self.friction.flange_a, self.motor.flange_a)
        yield connect(self.friction.flange_b, self.ground.flange)

    def equations(self):
        reference = 1 - cos(4 * time)
        yield self.error == 20 * (reference - self.motor.phi) - self.motor.w
        yield der(self.integral) == 20 * self.error
        yield self.torque.tau == 0.1 * (self.error + self.integral)


class Wound(Model):
    """A drive winds a spring at constant speed."""

    drive = rotational.Speed(w_ref=0.5 + 1e-12 * time, phi=fixed(0))
    spring = rotational.Spring(c=10.0)
    ground = rotational.Fixed()

    def connections(self):
        yield connect(self.drive.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.ground.flange)


class Cranked(Model):
    """A crank at constant speed stretches a spring: the motion is simple, the power is not."""

    world = World(gravity=None)
    drive = rotational.Speed(w_ref=3 + 1e-12 * time, phi=fixed(0))
    bearing = Revolute(use_axis_flange=True)
    arm = BodyShape(r=(0.3, 0, 0), m=1.0, r_CM=(0.1, 0, 0))
    anchor = Fixed(r=(1, 0.2, 0))
    spring = Spring(c=1e3, s_unstretched=0.1)

    def connections(self):
        yield chain(self.world, self.bearing, self.arm, self.spring)
        yield connect(self.spring.frame_b, self.anchor.frame_b)
        yield connect(self.drive.flange, self.bearing.axis)


class Oscillator(Model):
    """Mass on a spring, without a nominal value."""

    a: Scalar = parameter("amplitude", unit="m", default=1e-3)
    world = World(gravity=None)
    slide = Prismatic(n=(1, 0, 0), s=fixed(a), v=fixed(0))
    body = Body(m=1.0)
    anchor = Fixed(r=(-0.5, 0, 0))
    spring = Spring(c=40.0, s_unstretched=0.5)

    def connections(self):
        yield chain(self.world, self.slide, self.body)
        yield connect(self.anchor.frame_b, self.spring.frame_a)
        yield connect(self.spring.frame_b, self.slide.frame_b)
