"""Bodies without mass or inertia where nothing else guides them, and joints that carry nothing."""

import numpy as np

import acausal as ac
from acausal import Model, chain
from components import (
    Body,
    BodyBox,
    BodyRod,
    FixedTranslation,
    Prismatic,
    Revolute,
    Spherical,
    Spring,
    World,
    rotational,
)

I = np.eye(3)


class Arm(Model):
    """An arm that swings on a hinge; a joint and what it carries follow at its end."""

    world, hinge, arm = World(), Revolute(), BodyBox(r=(1, 0, 0), width=0.1)

    def connections(self):
        yield chain(self.world, self.hinge, self.arm, *self.end())

    def end(self):
        return ()


def run(model, parameters=None):
    ac.simulate(model, parameters=parameters, stop_time=0.1, initial="guesses")


def free_body_without_mass(repaired):
    class M(Model):
        world, ball = World(), Body(m=1 if repaired else 0, I=I)

    run(M())


def free_body_without_mass_and_inertia(repaired):
    class M(Model):
        world, ball = World(), Body(m=1, I=I) if repaired else Body(m=0)

    run(M())


def two_free_bodies_without_inertia(repaired):
    class M(Model):
        world, one, two = World(), Body(m=1, I=I), Body(m=1, I=I if repaired else np.zeros((3, 3)))
        three = Body(m=1, I=I if repaired else np.zeros((3, 3)))

    run(M())


def six_free_bodies_without_mass(repaired):
    class M(Model):
        world, m = World(), 1 if repaired else 0
        a, b, c = Body(m=m, I=I), Body(m=m, I=I), Body(m=m, I=I)
        d, e, f = Body(m=m, I=I), Body(m=m, I=I), Body(m=m, I=I)

    run(M())


def free_body_without_mass_later(repaired):
    class M(Model):
        world, ball = World(), Body(m=1, I=I)

    run(ac.compile(M()), {"ball.m": 2 if repaired else 0})


def free_body_without_inertia_later(repaired):
    class M(Model):
        world, ball = World(), Body(m=1, I=I)

    run(ac.compile(M()), {"ball.I": 2 * I if repaired else 0 * I})


def hinged_body_without_mass_at_the_end(repaired):
    class M(Arm):
        joint, ball = Revolute(), Body(m=1 if repaired else 0, r_CM=(1, 0, 0))

        def end(self):
            return self.joint, self.ball

    run(M())


def slide_of_a_body_without_mass(repaired):
    class M(Arm):
        joint, ball = Prismatic(), Body(m=1 if repaired else 0, I=I)

        def end(self):
            return self.joint, self.ball

    run(M())


def rod_without_mass_at_the_end(repaired):
    class M(Arm):
        joint, bar = Revolute(n=(0, 1, 0)), FixedTranslation(r=(0, 0, 1))
        rod = BodyRod(r=(1, 0, 0), m=1 if repaired else 0)

        def end(self):
            return self.joint, self.bar, self.rod

    run(M())


def body_on_a_spring_without_inertia(repaired):
    class M(Arm):
        spring, ball = Spring(c=1), Body(m=1, I=I if repaired else 0 * I, r_0=ac.guess((3, 0, 0)))

        def end(self):
            return self.spring, self.ball

    run(M())


def hinge_that_carries_nothing(repaired):
    class M(Arm):
        joint, ball = Revolute(), Body(m=1, I=I) if repaired else None

        def end(self):
            return (self.joint, self.ball) if repaired else (self.joint,)

    run(M())


def slide_that_carries_nothing(repaired):
    class M(Arm):
        joint, ball = Prismatic(), Body(m=1, I=I) if repaired else None

        def end(self):
            return (self.joint, self.ball) if repaired else (self.joint,)

    run(M())


def ball_joint_that_carries_nothing(repaired):
    class M(Arm):
        joint, ball = Spherical(), Body(m=1, I=I) if repaired else None

        def end(self):
            return (self.joint, self.ball) if repaired else (self.joint,)

    run(M())


def shaft_without_inertia(repaired):
    class M(Model):
        rotor = rotational.Inertia(J=1 if repaired else 0)

    run(M())
