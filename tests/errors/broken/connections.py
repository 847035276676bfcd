"""What is missing, doubled or of the wrong kind in a graph of components."""

import numpy as np

import acausal as ac
from acausal import Model, Scalar, chain, connect, fixed, variable
from components import Body, Fixed, FixedTranslation, Revolute, World, rotational
from tests.errors.broken.models import Pendulum, Rotor


def missing_world(repaired):
    class M(Model):
        mass = Body(m=1, I=np.eye(3))
        if repaired:
            world = World()

    ac.compile(M())


def second_world(repaired):
    class M(Pendulum):
        second = None if repaired else World()

    ac.compile(M())


def unconnected_joint(repaired):
    class M(Pendulum):
        spare = None if repaired else Revolute()

    ac.compile(M())


def unconnected_spring(repaired):
    class M(Rotor):
        spring = rotational.Spring(c=1)
        wall = rotational.Fixed()

        def connections(self):
            yield from super().connections()
            if repaired:
                yield chain(self.rotor, self.spring, self.wall)

    ac.compile(M())


def doubled_connection(repaired):
    class M(Pendulum):
        def connections(self):
            yield from super().connections()
            if not repaired:
                yield connect(self.bar.frame_b, self.mass.frame_a)

    ac.compile(M())


def frame_with_flange(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=True, phi=fixed(0), w=fixed(0))
        rotor = rotational.Inertia(J=1)

        def connections(self):
            yield from super().connections()
            yield connect(self.hinge.axis if repaired else self.hinge.frame_b, self.rotor.flange_a)

    ac.compile(M())


def port_of_an_option(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=repaired, phi=fixed(0), w=fixed(0))
        rotor = rotational.Inertia(J=1)

        def connections(self):
            yield from super().connections()
            yield connect(self.hinge.axis, self.rotor.flange_a)

    ac.compile(M())


def chain_without_end(repaired):
    class M(Model):
        world, hinge, mass = World(), Revolute(), Body(m=1, r_CM=(1, 0, 0))

        def connections(self):
            yield chain(*((self.world, self.hinge, self.mass) if repaired else (self.world, self.mass, self.hinge)))

    ac.compile(M())


def contradictory_start(repaired):
    class M(Pendulum):
        x: Scalar = variable("x", unit="m", start=0.5, fixed=not repaired)

        def equations(self):
            yield self.x == self.mass.r_0[0]

    ac.simulate(M(), stop_time=0.1)


def missing_start(repaired):
    class M(Pendulum):
        hinge = Revolute(phi=fixed(0.1), w=fixed(0)) if repaired else Revolute()

    ac.simulate(M(), stop_time=0.1)


def rigid_loop(repaired):
    class M(Model):
        world, bar, end = World(), FixedTranslation(r=(1, 0, 0)), Fixed(r=(2, 0, 0))

        def connections(self):
            yield chain(self.world, self.bar) if repaired else chain(self.world, self.bar, self.end.frame_b)

    ac.simulate(M(), stop_time=0.1)


def misspelt_part(repaired):
    class M(Pendulum):
        def connections(self):
            yield chain(self.world, self.hinge if repaired else self.hing, self.bar, self.mass)

    ac.compile(M())


def body_without_inertia(repaired):
    class M(Model):
        world = World()
        mass = Body(m=1, I=np.eye(3) if repaired else np.zeros((3, 3)))

    ac.compile(M())


def flange_of_an_option(repaired):
    class M(Pendulum):
        hinge = Revolute(use_axis_flange=repaired, phi=fixed(0), w=fixed(0))
        damper = rotational.Damper(d=1)

        def connections(self):
            yield from super().connections()
            yield from self.damped()

        def damped(self):
            yield chain(self.hinge.support, self.damper, self.hinge.axis)

    ac.compile(M())
