"""Runs that cannot be followed to their end, and starts that say too much or too little."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np

import acausal as ac
from acausal import (
    Model,
    Scalar,
    Vector3,
    acos,
    asin,
    chain,
    der,
    fixed,
    log,
    piecewise,
    reinit,
    sin,
    time,
    variable,
    when,
)
from components import Body, Revolute, Spherical, Spring, World
from tests.errors.broken.models import Decay, Pendulum


def point_mass_on_a_ball_joint(repaired):
    class M(Model):
        world, joint = World(), Spherical(angles_fixed=True, w_rel_a=fixed((0, 0, 0)))
        ball = Body(
            m=1, r_CM=(0, -1, 0) if repaired else (0, 0, 0), I=0.1 * np.eye(3) if repaired else np.zeros((3, 3))
        )

        def connections(self):
            yield chain(self.world, self.joint, self.ball)

    ac.compile(M())


def point_mass_on_a_spring(repaired):
    class M(Model):
        world, spring, ball = World(), Spring(c=1), Body(m=1, I=np.eye(3) if repaired else np.zeros((3, 3)))

        def connections(self):
            yield chain(self.world, self.spring, self.ball)

    ac.compile(M())


def point_mass_in_the_axis(repaired):
    class M(Model):
        world, hinge, ball = World(), Revolute(), Body(m=1, r_CM=(1 if repaired else 0, 0, 0))

        def connections(self):
            yield chain(self.world, self.hinge, self.ball)

    ac.compile(M())


def speed_of_a_body_besides_that_of_its_hinge(repaired):
    class M(Pendulum):
        def initial_equations(self):
            if not repaired:
                yield self.mass.v_0[1] == 2

    ac.simulate(M(), stop_time=0.01)


def start_that_follows_from_another(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=2 if repaired else 3, fixed=True)

        def more(self):
            yield self.z == 2 * self.x

    ac.simulate(M(), stop_time=0.01)


def start_against_an_equation(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=3, fixed=not repaired)

        def more(self):
            yield self.z == 2 * time

    ac.simulate(M(), stop_time=0.01)


def condition_of_time_without_value(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=0, fixed=True)

        def more(self):
            yield der(self.z) == piecewise((1, time < 0.9 if repaired else log(1 - time) > -2), 0)

    ac.simulate(M(), stop_time=2, intervals=10)


def condition_of_a_variable_without_value(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=0, fixed=True)

        def more(self):
            yield der(self.z) == piecewise((1, self.x > 0.51 if repaired else asin(2 * self.x - 2) > -1.5), 0)

    ac.simulate(M(), stop_time=2, intervals=10, method="idas")


def event_without_value(repaired):
    class M(Decay):
        def more(self):
            angle = acos(self.x if repaired else 2 * self.x - 1.5)
            yield when(angle > 3.5, reinit(self.x, 1))

    ac.simulate(M(), stop_time=2, intervals=10)


def condition_without_value_at_the_start(repaired):
    class M(Decay):
        def more(self):
            yield when(self.x < 1 if repaired else log(self.x - 1.5) < -1, reinit(self.x, 1.2))

    ac.simulate(M(), stop_time=0.1, intervals=10)


def output_without_value(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == (0 if repaired else log(self.x - 0.5))

    result = ac.simulate(M(), stop_time=1, intervals=10)
    _warned(lambda: result["z"])


def output_that_is_infinite_at_an_instant(repaired):
    class M(Decay):
        z: Vector3 = variable("z")

        def more(self):
            yield self.z == (0, 1 / (time + 0.5 if repaired else time - 0.5), 0)

    result = ac.simulate(M(), stop_time=1, intervals=10)
    _warned(lambda: result["z"])


def fall_into_the_centre_of_gravity(repaired):
    class M(Model):
        world = World(gravity="point", mu=1)
        ball = Body(
            m=1,
            I=np.eye(3),
            r_0=fixed((1, 0.3, 0.2)),
            v_0=fixed((-0.3, 1, 0) if repaired else (0, 0, 0)),
            w_a=fixed((0, 0, 0)),
            angles_fixed=True,
        )

    ac.simulate(M(), stop_time=3, intervals=2, method="idas")


def switching_without_measure(repaired):
    class M(Decay):
        z: Scalar = variable("z", start=0, fixed=True)

        def more(self):
            yield der(self.z) == piecewise((1, sin((10 if repaired else 3e6) * time) > 0), -1)

    _warned(lambda: ac.simulate(M(), stop_time=0.01, intervals=10))


def _warned(call: Callable[[], object]) -> None:
    """Call; a warning counts as refused."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            call()
        except ac.AcausalWarning as warning:
            raise ac.AcausalError(str(warning)) from None
