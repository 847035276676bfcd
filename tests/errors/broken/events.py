"""Conditions that find no rest, and jumps of what does not jump."""

import acausal as ac
from acausal import Model, Scalar, der, piecewise, reinit, sin, variable, when
from tests.errors.broken.models import Decay


def endless_bouncing(repaired):
    class Ball(Model):
        h: Scalar = variable("height", start=1, fixed=True)
        v: Scalar = variable("speed", start=0, fixed=True)

        def equations(self):
            yield der(self.h) == self.v
            yield der(self.v) == -10
            yield when(self.h < 0, reinit(self.v, -(1 if repaired else 0.5) * self.v))

    ac.simulate(Ball(), stop_time=2)


def force_that_changes_sign(repaired):
    class Relay(Model):
        x: Scalar = variable("x", start=1, fixed=True)

        def equations(self):
            yield der(self.x) == piecewise((-1, self.x > 0), 0 if repaired else 1)

    ac.simulate(Relay(), stop_time=2)


def jump_of_no_state(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == sin(self.x)
            yield when(self.x < 0.5, reinit(self.x if repaired else self.z, 1))

    ac.compile(M())


def when_at_the_start(repaired):
    class M(Decay):
        def initial_equations(self):
            if not repaired:
                yield when(self.x < 0.5, reinit(self.x, 1))

    ac.compile(M())


def when_without_condition(repaired):
    class M(Decay):
        def more(self):
            yield when(self.x < 0.5 if repaired else self.x, reinit(self.x, 1))

    ac.compile(M())


def modes_without_rest(repaired):
    class M(Decay):
        z: Scalar = variable("z")

        def more(self):
            yield self.z == piecewise((1, (self.x if repaired else self.z) < 0.5), 0)

    ac.simulate(M(), stop_time=0.1)
